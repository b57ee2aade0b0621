#include "figures/run_group.h"

#include <gtest/gtest.h>

#include "base/errors.h"
#include "unit/figures/example_figure_run.h"

namespace talus::figures {
namespace {

class RunGroups : public ::testing::Test {
 protected:
  RunGroups() { example::store_with_commits(path_, 1); }

  runs::RunView run(std::uint64_t seed) const { return example::figure_run(path_, seed); }
  runs::RunView walls(std::uint64_t seed, double length) const {
    runs::RunView result = run(seed);
    result.scenario.bed.boundary = scenario::BedBoundary::walls;
    result.scenario.bed.length = length;
    return result;
  }

  test::TemporaryFolder folder_;
  std::string path_ = folder_.path("run.h5");
};

template <typename... Runs>
std::vector<RunGroup> groups_of(Runs... runs) {
  std::vector<runs::RunView> all;
  (all.push_back(std::move(runs)), ...);
  return group_runs(std::move(all));
}

TEST_F(RunGroups, TakeRunsThatDifferInNothingThatShapesTheResult) {
  runs::RunView other = run(1);
  other.scenario.output.frame_every = 1.0;
  other.scenario.tilt.end_angle = 10.0;
  other.scenario.tilt.after_failure = scenario::AfterFailure::lower;
  other.scenario.tilt.lowering_rate = 1.0;
  other.scenario.deposition.max_time = 100.0;
  other.scenario.contact.wall_friction = 0.1;
  const auto groups = groups_of(run(2), std::move(other));
  ASSERT_EQ(groups.size(), 1u);
  EXPECT_EQ(groups[0].label, "PBC, L = 200 D");
  EXPECT_EQ(groups[0].runs[0].scenario.seed, 1u) << "in ascending order of seed";
  EXPECT_EQ(groups[0].runs[1].scenario.seed, 2u);
}

TEST_F(RunGroups, PartRunsByWhatMayShapeTheResult) {
  runs::RunView loose = run(1), fast = run(1), rubbed = walls(1, 100.0);
  loose.scenario.solver.tolerance = 1e-5;
  fast.scenario.tilt.rate = 2.0;
  rubbed.scenario.contact.wall_friction = 0.1;
  EXPECT_EQ(groups_of(run(1), std::move(loose), std::move(fast)).size(), 3u);
  EXPECT_EQ(groups_of(walls(1, 100.0), std::move(rubbed)).size(), 2u);
}

TEST_F(RunGroups, NameTheKeysThatTellThemApart) {
  runs::RunView other = run(1);
  other.scenario.deposition.friction = 0.15;
  const auto groups = groups_of(run(1), std::move(other), walls(1, 100.0));
  ASSERT_EQ(groups.size(), 3u);
  EXPECT_EQ(groups[0].label, "PBC, L = 200 D, deposition.friction = contact");
  EXPECT_EQ(groups[1].label, "PBC, L = 200 D, deposition.friction = 0.15");
  EXPECT_EQ(groups[2].label, "WBC, L = 100 D") << "its bed distinguishes it";
}

TEST_F(RunGroups, ComePeriodicFirstThenByLength) {
  const auto groups = groups_of(walls(1, 300.0), walls(1, 100.0), run(1));
  ASSERT_EQ(groups.size(), 3u);
  EXPECT_TRUE(groups[0].periodic());
  EXPECT_EQ(groups[1].label, "WBC, L = 100 D");
  EXPECT_EQ(groups[2].label, "WBC, L = 300 D");
}

TEST_F(RunGroups, PartRunsOfOneSeedThatEndedInOtherStates) {
  const auto of_ensemble = [&](std::uint64_t seed, const std::string& folder) {
    runs::RunView result = run(seed);
    result.path = "/runs/" + folder + "/ensemble.h5#seed-" + std::to_string(seed);
    result.state_hash = "of " + folder;
    return result;
  };
  const auto groups = groups_of(of_ensemble(1, "before"), of_ensemble(2, "before"), of_ensemble(1, "after"),
                                of_ensemble(2, "after"));
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(groups[0].label, "PBC, L = 200 D, before");
  EXPECT_EQ(groups[1].label, "PBC, L = 200 D, after");
  EXPECT_EQ(groups[1].runs.size(), 2u);
}

TEST_F(RunGroups, RefuseARunTwice) {
  try {
    groups_of(run(1), run(2), run(1));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_data);
    EXPECT_NE(std::string(error.what()).find(path_ + " and " + path_ + " are the same run"),
              std::string::npos);
  }
}

}  // namespace
}  // namespace talus::figures
