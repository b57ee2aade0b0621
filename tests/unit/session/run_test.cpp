/// Notifications to clients during a run. Run whose contacts resist rolling: its files, its memory, its
/// check, and requests that reject it. Commands of a scenario: the steps at which they are applied,
/// bit-identity with commands of a driver, and resuming, replaying and branching.

#include "session/run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/trigonometry.h"
#include "io/run_file.h"
#include "session/frame_state.h"
#include "session/run_check.h"
#include "session/run_header.h"
#include "support/exit_code.h"
#include "support/has.h"
#include "support/process.h"
#include "support/recorded_run.h"
#include "support/small_bed.h"
#include "support/temporary_folder.h"

namespace talus::session {
namespace {

const char* const tiny_bed =
    "seed = 5\n[bed]\nlength = 10\ndepth = 2\n[tilt]\nend_angle = 0.05\nstep = 0.01\n[output]\nframe_every = "
    "0.02\n";

/// Returns the final state of the bed.
std::uint64_t carried_through(const std::string& path, const RunControl& control) {
  const scenario::Scenario scenario = scenario::parse_scenario(tiny_bed, "tiny.toml");
  Session session(scenario);
  const io::RunHeader header = run_header(session, {});
  io::RunStore store = io::RunStore::create(path, header, false);
  EXPECT_EQ(run_to_end(session, store, control), RunEnd::complete);
  return state_hash(session.world());
}

using RunToEnd = test::FolderTest;

TEST_F(RunToEnd, each_frame_is_shown_once_in_its_order) {
  std::vector<std::int64_t> shown;
  RunControl control;
  control.on_frame = [&shown](const Frame& frame) { shown.push_back(frame.step); };
  const std::uint64_t watched = carried_through(folder.path("watched.h5"), control);
  const io::RunFile run = io::RunFile::open(folder.path("watched.h5"));
  std::vector<std::int64_t> stored;
  for (std::size_t k = 0; k < run.all_frame_tilts().size(); ++k) stored.push_back(run.positions(k).step);
  EXPECT_EQ(shown.size(), 4u) << "0, 0.02, 0.04 and 0.05 deg";
  EXPECT_EQ(shown, stored);
  EXPECT_EQ(watched, carried_through(folder.path("unwatched.h5"), {}));
}

TEST_F(RunToEnd, a_frame_is_shown_before_it_is_committed) {
  const std::string path = folder.path("run.h5");
  std::size_t shown = 0;
  RunControl control;
  control.on_frame = [&](const Frame&) {
    const bool committed = io::run_presence(path) == io::RunPresence::folder;
    EXPECT_EQ(committed ? io::RunFile::open(path).all_frame_tilts().size() : 0u, shown++);
  };
  carried_through(path, control);
  EXPECT_EQ(shown, 4u);
}

TEST_F(RunToEnd, stops_in_time_for_what_it_is_allowed) {
  EXPECT_FALSE(time_is_up(100.0, 98.9, 0.1));
  EXPECT_TRUE(time_is_up(100.0, 99.1, 0.1)) << "less than a hundredth remains";
  EXPECT_FALSE(time_is_up(100.0, 89.0, 5.0));
  EXPECT_TRUE(time_is_up(100.0, 91.0, 5.0)) << "two long steps would exceed it";
}

TEST_F(RunToEnd, told_to_stop_while_it_packs_it_stays_a_folder) {
  const std::string path = folder.path("run.h5");
  const scenario::Scenario scenario = scenario::parse_scenario(tiny_bed, "tiny.toml");
  Session session(scenario);
  io::RunHeader header = run_header(session, {});
  {
    io::RunStore store = io::RunStore::create(path, header, false);
    volatile std::sig_atomic_t stop = 0;
    RunControl control;
    control.stop = &stop;
    control.on_step = [&](const RunProgress& progress) { stop = progress.session.phase() == Phase::done; };
    EXPECT_EQ(run_to_end(session, store, control), RunEnd::stopped);
  }
  EXPECT_EQ(io::run_presence(path), io::RunPresence::folder);
  EXPECT_EQ(io::RunFile::open(path).all_frame_tilts().size(), 4u);
  io::Checkpoint checkpoint;
  io::RunStore store = io::RunStore::resume(path, header, checkpoint);
  Session resumed(scenario, std::move(checkpoint));
  EXPECT_EQ(run_to_end(resumed, store, {}), RunEnd::complete);
  EXPECT_EQ(io::run_presence(path), io::RunPresence::packed);
}

scenario::Scenario rolling_bed(double rolling_friction = 0.2) {
  scenario::Scenario scenario = test::small_tilted_bed(1.0);
  scenario.contact.rolling_friction = rolling_friction;
  return scenario;
}

using RollingRun = test::FolderTest;

TEST_F(RollingRun, stores_its_moments) {
  Session session(rolling_bed());
  const io::RunFile run = test::recorded(session, folder.path("run.h5"));
  EXPECT_EQ(state_hash(run.checkpoint().world), test::hash_of(session));
  EXPECT_EQ(run.checkpoint().world.contacts.moment.size(), run.checkpoint().world.contacts.a.size());
  ASSERT_GE(run.all_frame_tilts().size(), 3u);
  double largest = 0.0;
  for (std::size_t k = 0; k < run.all_frame_tilts().size(); ++k) {
    const Frame frame = run.frame(k);
    EXPECT_TRUE(run.is_as_written(frame, k)) << k;
    ASSERT_EQ(frame.contacts.moment.size(), frame.contacts.a.size()) << k;
    for (const double moment : frame.contacts.moment) largest = std::max(largest, std::fabs(moment));
  }
  EXPECT_GT(largest, 0.0);
  const RunCheck check = check_run(run, {});
  EXPECT_TRUE(check.faults.empty()) << check.faults.front();
}

TEST_F(RollingRun, that_rolls_freely_stores_none) {
  const io::RunFile run = test::recorded(rolling_bed(0.0), folder.path("run.h5"));
  EXPECT_TRUE(run.checkpoint().world.contacts.moment.empty());
  EXPECT_TRUE(run.frame(0).contacts.moment.empty());
  EXPECT_FALSE(test::has(test::text_of(folder.path("run.h5")), "/checkpoint/contact_moment"));
  test::recorded(rolling_bed(), folder.path("rolling.h5"));
  EXPECT_TRUE(test::has(test::text_of(folder.path("rolling.h5")), "/checkpoint/contact_moment"));
}

// Stopped after 40 steps again and again, and continued from the files.
TEST_F(RollingRun, resumed_from_its_files_gives_the_same_bits) {
  const scenario::Scenario scenario = rolling_bed();
  const io::RunFile whole = test::recorded(scenario, folder.path("whole.h5"));
  const std::string path = folder.path("run.h5");
  Session begun(scenario);
  io::RunHeader header = run_header(begun, {});
  io::RunStore::create(path, header, false).commit(begun.segment(), begun.checkpoint(0.0));
  volatile std::sig_atomic_t stop = 0;
  RunControl control;
  control.stop = &stop;
  control.on_step = [&stop](const RunProgress& progress) { stop = progress.session.world().step % 40 == 0; };
  int parts = 0;
  for (RunEnd end = RunEnd::stopped; end == RunEnd::stopped; ++parts) {
    io::Checkpoint checkpoint;
    io::RunStore store = io::RunStore::resume(path, header, checkpoint);
    Session session(scenario, std::move(checkpoint));
    end = run_to_end(session, store, control);
  }
  EXPECT_GT(parts, 3);
  const io::RunFile resumed = io::RunFile::open(path);
  EXPECT_EQ(state_hash(resumed.checkpoint().world), state_hash(whole.checkpoint().world));
  ASSERT_EQ(whole.all_frame_tilts(), resumed.all_frame_tilts());
  for (std::size_t k = 0; k < whole.all_frame_tilts().size(); ++k)
    EXPECT_EQ(whole.frame(k).contacts.moment, resumed.frame(k).contacts.moment) << k;
}

TEST_F(RollingRun, with_a_moment_that_cannot_be_is_found) {
  const auto change = [](io::Segment& segment) {
    double& moment = segment.frames[1].contacts.moment.at(0);
    moment = 1.0 + std::fabs(moment) * 100.0;
  };
  std::string faults;
  const io::RunFile run = test::stored(test::finished(rolling_bed()), folder.path("run.h5"), change);
  for (const std::string& fault : check_run(run, {}).faults) faults += fault + "\n";
  EXPECT_TRUE(test::has(faults, "mu_r (r_a + r_b) f_n, rolling friction allows 1"));
}

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

TEST(ScriptedRun, has_the_bits_of_one_that_is_driven) {
  const scenario::Scenario scenario = scripted_bed();
  std::vector<Command> commands;
  const Session scripted = run_session(scenario, commands);

  scenario::Scenario plain = scenario;
  plain.commands.clear();
  Session driven = test::tilting(plain);
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
  test::run_session(driven);
  EXPECT_EQ(test::hash_of(scripted), test::hash_of(driven));
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
    EXPECT_EQ(test::hash_of(resumed), test::hash_of(whole)) << every;
    EXPECT_EQ(test::stored_values(resumed), test::stored_values(whole)) << every;
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
    test::run_session(continued);
    EXPECT_EQ(test::hash_of(continued), test::hash_of(whole)) << "left after " << steps;
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
  const test::Refusal refused = test::refusal_of([&] { test::run_session(session); });
  EXPECT_EQ(refused.code, ExitCode::bad_data);
  EXPECT_EQ(refused.message, "command.2, at 1 deg: release: no grain is being dragged");
  EXPECT_TRUE(session.segment().commands.empty());
  EXPECT_NEAR(degrees(session.world().tilt), 1.0, 1e-9);
  const std::uint64_t state = test::hash_of(session);
  Session again(scenario, session.checkpoint(0.0));
  EXPECT_EQ(test::refusal_of([&] { test::run_session(again); }).message, refused.message)
      << "a resumed run does not pass it";
  EXPECT_EQ(test::hash_of(again), state);
}

TEST(ScriptedRun, refuses_a_grain_that_its_bed_does_not_have) {
  scenario::Scenario scenario = test::small_tilted_bed(2.0);
  scenario.commands = {{1.0, {}, CommandKind::push, 30, 0.0, 0.5}};
  EXPECT_THROW(Session{scenario}, Error);
}

TEST_F(RunToEnd, of_a_script_is_branched_with_the_commands_that_are_still_to_come) {
  const scenario::Scenario scenario = scripted_bed();
  const io::RunFile run = test::stored(test::finished(scenario), folder.path("run.h5"));
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
    test::run_session(branch);
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
