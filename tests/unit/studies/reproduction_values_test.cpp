/// Additional analyses of a member of a reproduction: missing ones are made, existing ones are kept.

#include "studies/reproduction_values.h"

#include <gtest/gtest.h>

#include "base/errors.h"
#include "base/hash.h"
#include "core/snapshot.h"
#include "ensemble/member_state.h"
#include "io/analysis_file.h"
#include "io/durable_file.h"
#include "runs/analysis_run.h"
#include "session/run.h"
#include "session/run_header.h"
#include "support/exit_code.h"
#include "support/small_bed.h"
#include "support/temporary_folder.h"

namespace talus::studies {
namespace {

namespace fs = std::filesystem;

class ReadingsTest : public testing::Test {
 protected:
  /// Returns a plan of one member whose run and analysis are complete.
  ReproductionPlan computed(const scenario::Scenario& scenario) const {
    ReproductionPlan plan{ensemble::plan_ensemble({1}, {{"bed", "", scenario}}, folder_.path().string()),
                          false};
    const ensemble::Member& member = plan.members.front();
    fs::create_directories(folder_.path("bed"));
    session::Session session(member.scenario);
    io::RunStore store =
        io::RunStore::create(member.path, session::run_header(session, {"", {}, "", 1}), false);
    session::run_to_end(session, store, {});
    const io::RunFile run = io::RunFile::open(member.path);
    const analysis::Analysis analysis = runs::analyse_run(run, analysis::AnalysisParameters(), 1, {});
    io::store_analysis(member.path, analysis, hash_text(state_hash(run.checkpoint().world)));
    return plan;
  }
  static std::vector<io::StoredReading> readings_of(const ensemble::Member& member) {
    return io::read_readings(io::RunFile::open(member.path));
  }
  test::TemporaryFolder folder_;
};

TEST_F(ReadingsTest, are_made_where_they_are_missing_and_measured) {
  const ReproductionPlan plan = computed(test::small_tilted_bed(1.0));
  const ensemble::Member& member = plan.members.front();
  EXPECT_FALSE(is_measured(member));
  EXPECT_EQ(test::exit_code_of([&] { measure_members(plan); }), ExitCode::bad_data);
  complete_readings(member);
  EXPECT_TRUE(is_measured(member));
  const std::vector<io::StoredReading> before = readings_of(member);
  EXPECT_EQ(before.size(), 12u);
  const std::string state = hash_text(state_hash(io::RunFile::open(member.path).checkpoint().world));
  std::vector<io::StoredReading> changed = before;
  changed[3].key = "of another version";
  changed[4].values[0] = 7.5;  // valid by its key, so it is accepted as it is
  io::store_readings(member.path, changed, state);
  EXPECT_FALSE(is_measured(member));
  complete_readings(member);
  EXPECT_TRUE(is_measured(member));
  EXPECT_EQ(readings_of(member)[3].key, before[3].key);
  EXPECT_EQ(readings_of(member)[4].values[0], 7.5);
  io::store_analysis(member.path, *io::read_analysis(member.path), state);
  EXPECT_EQ(readings_of(member).size(), 12u) << "a run that is analysed again keeps them";
  EXPECT_EQ(io::RunFile::open(member.path).changed_data_sets(), std::vector<std::string>());
  const auto written = fs::last_write_time(member.path);
  complete_readings(member);
  EXPECT_EQ(fs::last_write_time(member.path), written) << "nothing is missing";

  const ReproductionResult result = measure_members(plan);
  ASSERT_EQ(result.outcomes.size(), 1u);
  const ReproducedOutcome& outcome = result.outcomes.front();
  EXPECT_GT(outcome.seconds, 0.0);
  ASSERT_EQ(outcome.values.size(), chain_analyses(paper_depth).size());
  for (const auto& thresholds : outcome.values) EXPECT_FALSE(thresholds.empty());
  fs::remove(member.path);
  EXPECT_FALSE(is_measured(member)) << "without its run";
}

TEST_F(ReadingsTest, are_none_between_walls) {
  scenario::Scenario scenario = test::small_tilted_bed(1.0);
  scenario.bed.boundary = scenario::BedBoundary::walls;
  const ReproductionPlan plan = computed(scenario);
  complete_readings(plan.members.front());
  EXPECT_TRUE(readings_of(plan.members.front()).empty());
  EXPECT_TRUE(is_measured(plan.members.front()));
  const ReproductionResult result = measure_members(plan);
  ASSERT_EQ(result.outcomes.size(), 1u);
  EXPECT_FALSE(result.outcomes[0].values.front().empty());
  EXPECT_TRUE(result.outcomes[0].values[1].empty());
  io::remove_file(plan.members.front().path);
  EXPECT_TRUE(measure_members(plan).outcomes.empty()) << "for an unfinished member";
}

}  // namespace
}  // namespace talus::studies
