/// The table of trials as text and back.

#include "session/perturbation_table.h"

#include <gtest/gtest.h>

#include <string>

#include "core/errors.h"

namespace talus {
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

ExitCode code_of(const std::string& text, const PerturbationPlan& plan) {
  try {
    parse_perturbation_csv(text, "seed-1.csv", plan);
    return ExitCode::done;
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("seed-1.csv"), std::string::npos);
    return error.code();
  }
}

TEST(PerturbationTable, reads_back_to_the_last_bit) {
  PerturbationTable table = example();
  for (const bool complete : {false, true}) {
    table.complete = complete;
    const std::string text = perturbation_csv(table);
    const PerturbationTable read = parse_perturbation_csv(text, "seed-1.csv", table.plan);
    EXPECT_EQ(read.complete, complete);
    ASSERT_EQ(read.states.size(), 2u);
    EXPECT_EQ(read.states[0].trials.size(), 2u);
    EXPECT_EQ(read.states[0].trials[1].end, TrialEnd::undecided);
    EXPECT_EQ(read.states[0].trials[0].time, 1.0 / 3.0);
    EXPECT_EQ(read.states[1].tilt, 12.75);
    EXPECT_EQ(read.states[1].trials[0].moved, 412);
    EXPECT_EQ(perturbation_csv(read), text);
  }
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

TEST(PerturbationTable, of_another_plan_is_refused) {
  const std::string text = perturbation_csv(example());
  PerturbationPlan plan = example().plan;
  EXPECT_EQ(code_of(text, plan), ExitCode::done);
  plan.every = 0.5;
  EXPECT_EQ(code_of(text, plan), ExitCode::bad_data);
  plan = example().plan;
  plan.patch.depth = 2.0;
  EXPECT_EQ(code_of(text, plan), ExitCode::bad_data);
}

TEST(PerturbationTable, that_is_damaged_is_refused) {
  const std::string text = perturbation_csv(example());
  const PerturbationPlan plan = example().plan;
  EXPECT_EQ(code_of("", plan), ExitCode::bad_data);
  EXPECT_EQ(code_of(text.substr(0, text.find('\n') + 1), plan), ExitCode::bad_data);
  EXPECT_EQ(code_of(text.substr(0, text.size() - 10), plan), ExitCode::bad_data);
  EXPECT_EQ(code_of(text + "13,0,0,slept,1,0,0\n", plan), ExitCode::bad_data);
  EXPECT_EQ(code_of(text + "13,0,0,rest,1,0,0,7\n", plan), ExitCode::bad_data);
}

TEST(Patch, is_read_as_width_by_depth) {
  EXPECT_EQ(parse_patch("10x2"), (SurfacePatch{10.0, 2.0}));
  EXPECT_EQ(parse_patch("2.5x0.5"), (SurfacePatch{2.5, 0.5}));
  EXPECT_EQ(patch_text({2.5, 0.5}), "2.5x0.5");
  for (const char* bad : {"", "10", "10x", "x2", "10x2x3", "0x2", "10x-1", "nanx2", "1e9x1", "10 x 2"})
    EXPECT_FALSE(parse_patch(bad).has_value()) << bad;
}

}  // namespace
}  // namespace talus
