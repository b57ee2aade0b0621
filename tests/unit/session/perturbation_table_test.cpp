/// Trials of a run, stored and read back.

#include "session/perturbation_table.h"

#include <gtest/gtest.h>

#include <string>

#include "session/run_header.h"
#include "support/exit_code.h"
#include "support/small_bed.h"
#include "support/temporary_folder.h"

namespace talus::session {
namespace {

PerturbationTable example() {
  PerturbationTable table;
  table.plan = {12.5, 0.25, {10.0, 1.5}};
  table.states = {
      {12.5,
       {{0.0, 0.0, TrialEnd::rest, 1.0 / 3.0, 0, 1e-7}, {5.0, 295.5, TrialEnd::undecided, 200.0, 3, 0.5}}},
      {12.75, {{0.0, 0.0, TrialEnd::avalanche, 20.0, 412, 5.01}}}};
  return table;
}

/// Run in progress, with the trials of a table.
class StoredTrials : public testing::Test {
 protected:
  void store(const PerturbationTable& table) {
    const Session session(test::small_tilted_bed(1.0));
    io::RunHeader header = run_header(session, {"", {}, "", 1});
    header.provenance.emplace_back(trials_fact, plan_text(table.plan));
    io::RunStore store = io::RunStore::create(path_, header, false);
    for (const PerturbedState& state : table.states) {
      io::Segment segment;
      segment.trials = rows_of(state, 0);
      store.commit(segment, session.checkpoint(0.0));
    }
  }
  PerturbationTable read(const PerturbationPlan& plan) const {
    return table_of(io::RunFile::open(path_), plan, "seed-1.h5");
  }

  test::TemporaryFolder folder_;
  std::string path_ = folder_.path("seed-1.h5");
};

TEST_F(StoredTrials, are_read_back_to_the_last_bit) {
  store(example());
  const PerturbationTable found = read(example().plan);
  ASSERT_EQ(found.states.size(), 2u);
  ASSERT_EQ(found.states[0].trials.size(), 2u);
  EXPECT_EQ(found.states[0].trials[1].end, TrialEnd::undecided);
  EXPECT_EQ(found.states[0].trials[0].time, 1.0 / 3.0);
  EXPECT_EQ(found.states[1].tilt, 12.75);
  EXPECT_EQ(found.states[1].trials[0].moved, 412);
  for (std::size_t k = 0; k < 2; ++k) EXPECT_EQ(rows_of(found.states[k], 7), rows_of(example().states[k], 7));
}

TEST_F(StoredTrials, of_another_plan_are_refused) {
  store(example());
  PerturbationPlan plan = example().plan;
  plan.every = 0.5;
  EXPECT_EQ(test::exit_code_of([&] { read(plan); }), ExitCode::bad_data);
  plan = example().plan;
  plan.patch.depth = 2.0;
  EXPECT_EQ(test::exit_code_of([&] { read(plan); }), ExitCode::bad_data);
}

TEST_F(StoredTrials, that_end_as_none_does_are_refused) {
  PerturbationTable table = example();
  table.states[0].trials[0].end = static_cast<TrialEnd>(3);
  store(table);
  EXPECT_EQ(test::exit_code_of([&] { read(table.plan); }), ExitCode::bad_data);
}

TEST(PerturbationPlan, is_read_back_from_its_text_alone) {
  const PerturbationPlan plan = example().plan;
  EXPECT_EQ(plan_text(plan), "--from 12.5 --every 0.25 --patch 10x1.5");
  EXPECT_EQ(parse_plan(plan_text(plan)), plan);
  for (const char* text :
       {"", "--from 12.5 --every 0.25", "--from 12.5 --every 0.25 --patch 10x1.5 --all",
        "--from 12.5 --each 0.25 --patch 10x1.5", "--from 12.50 --every 0.25 --patch 10x1.5"})
    EXPECT_FALSE(parse_plan(text).has_value()) << text;
}

TEST(Patch, is_read_as_width_by_depth) {
  EXPECT_EQ(parse_patch("10x2"), (SurfacePatch{10.0, 2.0}));
  EXPECT_EQ(parse_patch("2.5x0.5"), (SurfacePatch{2.5, 0.5}));
  EXPECT_EQ(patch_text({2.5, 0.5}), "2.5x0.5");
  for (const char* bad : {"", "10", "10x", "x2", "10x2x3", "0x2", "10x-1", "nanx2", "1e9x1", "10 x 2"})
    EXPECT_FALSE(parse_patch(bad).has_value()) << bad;
}

}  // namespace
}  // namespace talus::session
