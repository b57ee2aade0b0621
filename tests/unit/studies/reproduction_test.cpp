/// Runs of a reproduction: the paper's beds, and smaller ones of the same shape.

#include "studies/reproduction.h"

#include <gtest/gtest.h>

#include <map>

#include "base/errors.h"
#include "studies/built_in_scenarios.h"

namespace talus::studies {
namespace {

TEST(Reproduction, runs_the_beds_of_the_paper) {
  const ReproductionPlan plan = plan_reproduction(false, "1-2", "folder");
  ASSERT_EQ(plan.variants.size(), 8u);
  EXPECT_EQ(plan.members.size(), 16u);
  const scenario::DepositionMethod methods[] = {scenario::DepositionMethod::pour,
                                                scenario::DepositionMethod::geometric,
                                                scenario::DepositionMethod::collapse};
  for (std::size_t b = 0; b < 3; ++b) {
    EXPECT_TRUE(is_periodic(plan.variants[b]));
    EXPECT_EQ(plan.variants[b].scenario.deposition.method, methods[b]);
    EXPECT_EQ(plan.variants[b].scenario.bed.length, 200.0);
  }
  for (std::size_t b = 3; b < 8; ++b) {
    EXPECT_FALSE(is_periodic(plan.variants[b]));
    EXPECT_EQ(plan.variants[b].scenario.bed.length, 100.0 + 50.0 * static_cast<double>(b - 3));
    EXPECT_EQ(plan.variants[b].scenario.bed.depth, 40.0);
  }
}

TEST(QuickReproduction, keeps_depth_over_length) {
  const ReproductionPlan full = plan_reproduction(false, "1", "folder");
  const ReproductionPlan quick = plan_reproduction(true, "1", "folder");
  for (std::size_t b = 0; b < full.variants.size(); ++b) {
    EXPECT_DOUBLE_EQ(depth_over_length(quick.variants[b]), depth_over_length(full.variants[b]));
    EXPECT_EQ(quick.variants[b].scenario.bed.depth, 20.0);
  }
  EXPECT_EQ(quick.variants[3].name, "wbc-50");
}

TEST(Reproduction, has_a_name_of_its_own_for_each_run) {
  const ReproductionPlan plan = plan_reproduction(false, "1-3", "folder");
  std::map<std::string, int> names;
  for (const ensemble::Member& run : plan.members) ++names[run.name];
  EXPECT_EQ(names.size(), plan.members.size());
  EXPECT_EQ(plan.members.front().path, "folder/pbc/seed-1.h5");
}

TEST(Reproduction, of_no_seeds_is_refused) { EXPECT_THROW(plan_reproduction(false, "2-1", "folder"), Error); }

TEST(BuiltInScenarios, that_do_not_exist_are_a_defect) { EXPECT_THROW(built_in_scenario("paper"), Error); }

}  // namespace
}  // namespace talus::studies
