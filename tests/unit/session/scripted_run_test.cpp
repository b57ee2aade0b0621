/// Commands of a scenario: the steps at which they are applied, bit-identity with commands of a driver, and
/// resuming, replaying and branching.

#include <gtest/gtest.h>

#include <cmath>

#include "base/errors.h"
#include "core/trigonometry.h"
#include "io/run_file.h"
#include "session/branch_start.h"
#include "session/frame_state.h"
#include "session/run.h"
#include "session/run_header.h"
#include "support/small_bed.h"
#include "support/temporary_folder.h"

namespace talus::session {
namespace {

using scenario::ScriptedCommand;

scenario::Scenario scripted_bed() {
  scenario::Scenario scenario = test::small_tilted_bed(2.0);
  scenario.commands = {{1.05, {}, CommandKind::drop, 4, 0.05, 0.02},
                       {0.0, {}, CommandKind::push, 7, 0.0, 0.5},
                       {{}, 0.0754, CommandKind::friction, -1, 0.3, 0.0},
                       {1.05, {}, CommandKind::tilt_rate, -1, 10.0, 0.0},
                       {30.0, {}, CommandKind::friction, -1, 0.1, 0.0}};
  return scenario;
}

/// Runs to the end, optionally recreating the session from its checkpoint every `resume_every` steps.
Session run_session(const scenario::Scenario& scenario, std::vector<Command>& commands, int resume_every = 0,
                    int threads = 1) {
  Session session(scenario);
  while (session.phase() != Phase::done) {
    session.use_threads(threads);
    session.advance();
    if (resume_every == 0 || session.world().step % resume_every != 0) continue;
    for (const Command& command : session.segment().commands) commands.push_back(command);
    session = Session(scenario, session.checkpoint(0.0));
  }
  for (const Command& command : session.segment().commands) commands.push_back(command);
  return session;
}

std::uint64_t hash_of(const Session& session) { return state_hash(session.world()); }

TEST(ScriptedRun, has_the_bits_of_one_that_is_driven) {
  const scenario::Scenario scenario = scripted_bed();
  std::vector<Command> commands;
  const Session scripted = run_session(scenario, commands);

  scenario::Scenario plain = scenario;
  plain.commands.clear();
  Session driven(plain);
  while (driven.phase() == Phase::deposition) driven.advance();
  const std::int64_t began = driven.world().step;
  driven.apply({0, CommandKind::push, 7, 0.0, 0.5});
  while (driven.world().tilt < radians(1.05) - 1e-9) {
    // 75.4 steps of 1 ms after the beginning of the tilt, which is later.
    ASSERT_LT(driven.world().step, began + 75);
    driven.advance();
  }
  driven.apply({0, CommandKind::drop, 4, 0.05, 0.02});
  driven.apply({0, CommandKind::tilt_rate, -1, 10.0, 0.0});
  while (driven.world().step < began + 75) driven.advance();
  driven.apply({0, CommandKind::friction, -1, 0.3, 0.0});
  while (driven.phase() != Phase::done) driven.advance();
  EXPECT_EQ(hash_of(scripted), hash_of(driven));
  EXPECT_EQ(commands, driven.segment().commands) << "stored in the run file like commands of a user";
  EXPECT_EQ(commands.size(), 4u);
  EXPECT_EQ(waiting_commands(scenario, scripted.schedule()), std::vector<std::size_t>{4});
}

TEST(ScriptedRun, is_resumed_to_the_same_bits_wherever_it_was_left) {
  std::vector<Command> expected;
  const Session whole = run_session(scripted_bed(), expected);
  for (const int every : {1, 7, 53}) {
    std::vector<Command> commands;
    const Session resumed = run_session(scripted_bed(), commands, every, 1 + every % 2);
    EXPECT_EQ(hash_of(resumed), hash_of(whole)) << every;
    EXPECT_EQ(schedule_hash(resumed.schedule()), schedule_hash(whole.schedule())) << every;
    EXPECT_EQ(commands, expected) << every;
  }
}

TEST(ScriptedRun, is_replayed_without_giving_a_command_twice) {
  std::vector<Command> commands;
  const Session whole = run_session(scripted_bed(), commands);
  for (const std::int64_t steps : {whole.world().step, commands[1].step, commands[1].step + 1}) {
    Session session(scripted_bed());
    std::vector<Command> until;
    for (const Command& command : commands)
      if (command.step < steps) until.push_back(command);
    EXPECT_EQ(replay(session, nullptr, until, steps, {}), RunEnd::complete);
    EXPECT_EQ(session.world().step, steps);
    Session continued(scripted_bed(), session.checkpoint(0.0));
    while (continued.phase() != Phase::done) continued.advance();
    EXPECT_EQ(hash_of(continued), hash_of(whole)) << "left after " << steps;
  }
}

TEST(ScriptedRun, follows_a_tilt_that_comes_back) {
  scenario::Scenario scenario = test::small_tilted_bed(1.0);
  scenario.tilt.end_angle.reset();
  scenario.tilt.program = {"to 1", "to -1", "2 times"};
  scenario.commands = {{-0.4, {}, CommandKind::friction, -1, 0.3, 0.0},
                       {0.4, {}, CommandKind::friction, -1, 0.2, 0.0}};
  std::vector<Command> commands;
  const Session session = run_session(scenario, commands, 13);
  ASSERT_EQ(commands.size(), 2u) << "each once";
  EXPECT_EQ(commands[0].x, 0.2);
  EXPECT_EQ(commands[1].step - commands[0].step, 30 + 70) << "on the way back";
}

TEST(ScriptedRun, that_cannot_go_on_leaves_the_state_before_the_command) {
  scenario::Scenario scenario = test::small_tilted_bed(2.0);
  scenario.commands = {{1.0, {}, CommandKind::push, 7, 0.0, 0.5},
                       {1.0, {}, CommandKind::release, -1, 0.0, 0.0}};
  Session session(scenario);
  const auto message = [&](Session& subject) -> std::string {
    try {
      while (subject.phase() != Phase::done) subject.advance();
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::bad_data);
      return error.what();
    }
    return "done";
  };
  const std::string refused = "command.2, at 1 deg: release: no grain is being dragged";
  EXPECT_EQ(message(session), refused);
  EXPECT_TRUE(session.segment().commands.empty());
  EXPECT_NEAR(degrees(session.world().tilt), 1.0, 1e-9);
  const std::uint64_t state = hash_of(session);
  Session again(scenario, session.checkpoint(0.0));
  EXPECT_EQ(message(again), refused) << "a resumed run does not pass it";
  EXPECT_EQ(hash_of(again), state);
}

TEST(ScriptedRun, refuses_a_grain_that_its_bed_does_not_have) {
  scenario::Scenario scenario = test::small_tilted_bed(2.0);
  scenario.commands = {{1.0, {}, CommandKind::push, 30, 0.0, 0.5}};
  EXPECT_THROW(Session{scenario}, Error);
}

TEST(ScriptedRun, is_branched_with_the_commands_that_are_still_to_come) {
  const test::TemporaryFolder folder;
  const scenario::Scenario scenario = scripted_bed();
  Session session(scenario);
  {
    io::RunStore store = io::RunStore::create(folder.path("run.h5"), run_header(session, {}), false);
    ASSERT_EQ(run_to_end(session, store, {}), RunEnd::complete);
  }
  const io::RunFile run = io::RunFile::open(folder.path("run.h5"));
  const auto steps_of = [](const std::vector<Command>& commands) {
    std::vector<std::int64_t> steps;
    for (const Command& command : commands) steps.push_back(command.step);
    return steps;
  };
  std::size_t branched = 0;
  for (std::size_t k = 0; k + 1 < run.all_frame_tilts().size(); ++k) {
    const io::BranchOrigin origin{"run.h5", static_cast<std::int64_t>(k), "", checkpoint_at_frame(run, k)};
    check_branch_start(origin, scenario, "run.h5");
    Session branch(scenario, origin.start);
    while (branch.phase() != Phase::done) branch.advance();
    std::vector<Command> later;
    for (const Command& command : run.commands())
      if (command.step >= origin.start.world.step) later.push_back(command);
    EXPECT_EQ(steps_of(branch.segment().commands), steps_of(later)) << "from frame " << k;
    branched += later.size();
  }
  EXPECT_GE(branched, 4u);
}

}  // namespace
}  // namespace talus::session
