/// What is run: the paper's beds, and smaller ones of the same shape.

#include "reproduction/plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "core/errors.h"
#include "reproduction/built_in_scenarios.h"
#include "session/estimate.h"

namespace talus {
namespace {

TEST(Reproduction, runs_the_beds_of_the_paper) {
  const ReproductionPlan plan = plan_reproduction(false, "1-2");
  ASSERT_EQ(plan.beds.size(), 8u);
  EXPECT_EQ(plan.runs.size(), 16u);
  const DepositionMethod methods[] = {DepositionMethod::pour, DepositionMethod::geometric,
                                      DepositionMethod::collapse};
  for (std::size_t b = 0; b < 3; ++b) {
    EXPECT_TRUE(plan.beds[b].periodic());
    EXPECT_EQ(plan.beds[b].scenario.deposition.method, methods[b]);
    EXPECT_EQ(plan.beds[b].scenario.bed.length, 200.0);
  }
  for (std::size_t b = 3; b < 8; ++b) {
    EXPECT_FALSE(plan.beds[b].periodic());
    EXPECT_EQ(plan.beds[b].scenario.bed.length, 100.0 + 50.0 * static_cast<double>(b - 3));
    EXPECT_EQ(plan.beds[b].scenario.bed.depth, 40.0);
  }
}

TEST(QuickReproduction, keeps_depth_over_length) {
  const ReproductionPlan full = plan_reproduction(false, "1");
  const ReproductionPlan quick = plan_reproduction(true, "1");
  for (std::size_t b = 0; b < full.beds.size(); ++b) {
    EXPECT_DOUBLE_EQ(quick.beds[b].depth_over_length(), full.beds[b].depth_over_length());
    EXPECT_EQ(quick.beds[b].scenario.bed.depth, 20.0);
  }
  EXPECT_EQ(quick.beds[3].name, "wbc-50");
}

TEST(Reproduction, begins_each_seed_with_the_cheapest) {
  const ReproductionPlan plan = plan_reproduction(false, "3,1");
  for (std::size_t r = 1; r < plan.runs.size(); ++r) {
    const ReproducedRun& before = plan.runs[r - 1];
    const ReproducedRun& run = plan.runs[r];
    EXPECT_LE(before.seed, run.seed);
    if (before.seed == run.seed) {
      EXPECT_LE(estimate(before.scenario).seconds, estimate(run.scenario).seconds);
    }
    EXPECT_EQ(run.scenario.seed, run.seed);
  }
  EXPECT_EQ(plan.runs.front().name, "wbc-100/seed-1");
}

TEST(Reproduction, has_a_name_of_its_own_for_each_run) {
  const ReproductionPlan plan = plan_reproduction(false, "1-3");
  std::map<std::string, int> names;
  for (const ReproducedRun& run : plan.runs) ++names[run.name];
  EXPECT_EQ(names.size(), plan.runs.size());
  EXPECT_EQ(runs_of(plan, 0).size(), 3u);
}

TEST(Reproduction, of_no_seeds_is_refused) { EXPECT_THROW(plan_reproduction(false, "2-1"), Error); }

TEST(BuiltInScenarios, that_do_not_exist_are_a_defect) { EXPECT_THROW(built_in_scenario("paper"), Error); }

}  // namespace
}  // namespace talus
