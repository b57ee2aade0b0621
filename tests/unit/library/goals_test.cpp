/// Goals of calls that step: tilts from either side, and times.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/errors.h"
#include "base/hash.h"
#include "io/run_file.h"
#include "library/simulation.h"
#include "session/run.h"
#include "session/run_header.h"
#include "support/exit_code.h"
#include "support/small_bed.h"
#include "support/temporary_folder.h"

namespace talus {
namespace {

TEST(Goals, end_a_call) {
  Simulation sim(test::small_tilted_bed(5.0));
  sim.step(2);
  EXPECT_EQ(sim.world().step, 2);
  sim.deposit();
  EXPECT_EQ(sim.phase(), session::Phase::tilt);
  EXPECT_EQ(sim.tilt(), 0.0);
  sim.tilt_to(2.0);
  EXPECT_NEAR(sim.tilt(), 2.0, 0.021);
  sim.tilt_by(0.5);
  EXPECT_NEAR(sim.tilt(), 2.5, 0.021);
  const double time = sim.world().time;
  sim.set_tilt_rate(0.0);
  sim.run(0.05);
  EXPECT_NEAR(sim.world().time - time, 0.05, 1e-3);
  EXPECT_NEAR(sim.tilt(), 2.5, 0.021);
  EXPECT_EQ(sim.tilt_rate(), 0.0);
}

TEST(Goals, of_the_tilt_are_passed_from_either_side_and_turn_it) {
  const test::TemporaryFolder folder;
  Simulation sim(test::small_tilted_bed(5.0));  // 0.02 deg per step
  sim.record(folder.path("run.h5"));
  sim.tilt_to(0.0);
  EXPECT_EQ(sim.phase(), session::Phase::tilt) << "the deposition is completed";
  const std::int64_t begin = sim.world().step;
  sim.tilt_to(2.0);
  sim.tilt_to(0.5);
  EXPECT_NEAR(sim.tilt(), 0.5, 1e-9);
  EXPECT_NEAR(sim.tilt_rate(), -20.0, 1e-12);
  EXPECT_EQ(sim.world().step - begin, 100 + 75);
  sim.tilt_by(-1.0);
  EXPECT_NEAR(sim.tilt(), -0.5, 1e-9);
  EXPECT_EQ(sim.world().step - begin, 100 + 75 + 50) << "already on its way: no further command";
  sim.tilt_by(0.0);
  sim.tilt_to(sim.tilt());
  EXPECT_EQ(sim.world().step - begin, 225);
  sim.tilt_by(0.25);
  EXPECT_NEAR(sim.tilt(), -0.24, 1e-9) << "the first step beyond it";
  sim.finish();
  EXPECT_NEAR(sim.tilt(), 5.0, 1e-9);
  const io::RunFile run = io::RunFile::open(folder.path("run.h5"));
  const std::vector<Command> commands = run.commands();
  ASSERT_EQ(commands.size(), 2u);
  EXPECT_EQ(commands[0], (Command{begin + 100, CommandKind::tilt_rate, -1, -20.0, 0.0}));
  EXPECT_EQ(commands[1], (Command{begin + 225, CommandKind::tilt_rate, -1, 20.0, 0.0}));
  session::Session again = session::session_at_start(run.header(), "run");
  session::replay(again, nullptr, run.commands(), again.world().step + 1'000'000, {});
  EXPECT_EQ(hash_text(state_hash(again.world())), sim.state_hash());
}

TEST(Goals, within_a_step_are_met_exactly_in_the_long_run) {
  Simulation sim(test::small_tilted_bed(5.0));  // 0.02 deg per step
  sim.deposit();
  const std::int64_t begin = sim.world().step;
  for (int k = 0; k < 50; ++k) sim.tilt_by(0.028);
  EXPECT_NEAR(sim.tilt(), 1.4, 1e-9);
  for (int k = 0; k < 40; ++k) sim.tilt_by(0.005);
  EXPECT_NEAR(sim.tilt(), 1.6, 1e-9);
  EXPECT_EQ(sim.world().step - begin, 80);
  sim.tilt_by(0.013);
  Simulation copy = sim;
  for (int k = 0; k < 10; ++k) copy.tilt_by(0.013);
  EXPECT_NEAR(copy.tilt(), 1.76, 1e-9) << "the first step beyond 1.743";
  copy.step();
  copy.tilt_by(0.013);
  EXPECT_NEAR(copy.tilt(), 1.80, 1e-9) << "from where a step led: 1.78 + 0.013";
  sim.set_tilt_rate(-20.0);
  for (int k = 0; k < 10; ++k) sim.tilt_by(-0.013);
  EXPECT_NEAR(sim.tilt(), 1.48, 1e-9) << "from where the rate was set: 1.62 - 0.13 = 1.49";
}

TEST(Goals, that_the_last_step_has_passed_do_not_turn_the_tilt) {
  Simulation sim(test::small_tilted_bed(5.0));  // 0.02 deg per step
  for (int k = 1; k < 30; ++k) {
    const double before = sim.tilt();
    sim.tilt_to(k * 0.005);
    EXPECT_GE(sim.tilt(), before);
    EXPECT_LT(std::abs(sim.tilt() - k * 0.005), 0.02);
  }
  for (const double goal : {2.013, 2.013, 2.001}) {
    sim.tilt_to(goal);
    EXPECT_NEAR(sim.tilt(), 2.02, 1e-9);
    EXPECT_NEAR(sim.tilt_rate(), 20.0, 1e-12);
  }
  for (const double goal : {1.993, 1.993}) {
    sim.tilt_to(goal);
    EXPECT_NEAR(sim.tilt(), 1.98, 1e-9);
    EXPECT_NEAR(sim.tilt_rate(), -20.0, 1e-12);
  }
}

TEST(Goals, are_passed_by_a_programme_from_either_side) {
  scenario::Scenario scenario = test::small_tilted_bed(5.0);
  scenario.tilt.end_angle.reset();
  scenario.tilt.program = {"to 2", "to -2", "to 1"};
  Simulation sim(scenario);
  sim.deposit();
  const std::int64_t begin = sim.world().step;
  sim.tilt_by(-1.0);
  EXPECT_NEAR(sim.tilt(), -1.0, 1e-9);
  EXPECT_EQ(sim.world().step - begin, 100 + 150);
  EXPECT_EQ(test::exit_code_of([&] { sim.tilt_to(1.5); }), ExitCode::usage) << "it ends at 1 deg";
  EXPECT_EQ(sim.world().step - begin, 250);
  sim.tilt_to(0.5);
  EXPECT_EQ(sim.world().step - begin, 300 + 125);
  sim.set_tilt_rate(20.0);  // ends the programme
  sim.tilt_to(1.5);
  EXPECT_NEAR(sim.tilt(), 1.5, 1e-9);
}

TEST(Goals, to_which_the_flow_after_failure_does_not_lead_are_refused) {
  scenario::Scenario scenario = test::small_tilted_bed(5.0);
  scenario.contact.friction = 0.05;
  scenario.tilt.end_angle.reset();
  scenario.tilt.after_failure = scenario::AfterFailure::lower;
  scenario.tilt.lowering_rate = 100.0;
  Simulation sim(scenario);
  sim.run_until([&] { return sim.phase() == session::Phase::flow; });
  const double failed_at = sim.tilt();
  EXPECT_EQ(test::exit_code_of([&] { sim.tilt_by(1.0); }), ExitCode::usage);
  EXPECT_EQ(test::exit_code_of([&] { sim.tilt_to(-1.0); }), ExitCode::usage);
  sim.tilt_by(-0.5);
  EXPECT_TRUE(sim.done() || std::abs(sim.tilt() - (failed_at - 0.5)) < 0.1 + 1e-9) << "0.1 deg per step";
}

TEST(Goals, of_time_carry_over_the_fractions_of_steps) {
  Simulation sim(test::small_tilted_bed(20.0));  // steps of 1 ms
  sim.deposit();
  const std::int64_t begin = sim.world().step;
  for (int k = 0; k < 60; ++k) sim.run(0.0033);
  EXPECT_EQ(sim.world().step - begin, 198);
  for (int k = 0; k < 10; ++k) sim.run(0.0006);
  EXPECT_EQ(sim.world().step - begin, 204);
  sim.run(0.0012);
  Simulation copy = sim;
  for (int k = 0; k < 4; ++k) copy.run(0.0012);
  EXPECT_EQ(copy.world().step - begin, 210);
  for (const double seconds : {-1.0, 0.0, 0.0002, std::nan(""), std::numeric_limits<double>::infinity()})
    EXPECT_EQ(test::exit_code_of([&] { sim.run(seconds); }), ExitCode::usage) << seconds;
  EXPECT_EQ(sim.world().step - begin, 205);
}

}  // namespace
}  // namespace talus
