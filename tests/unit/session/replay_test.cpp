/// A run is determined by its scenario and its commands: replayed, resumed, interrupted.

#include <gtest/gtest.h>

#include <optional>

#include "base/errors.h"
#include "core/trigonometry.h"
#include "io/run_file.h"
#include "problems/step_problem.h"
#include "session/run.h"
#include "session/run_header.h"
#include "support/recorded_run.h"
#include "support/small_bed.h"
#include "support/temporary_folder.h"

namespace talus::session {
namespace {

scenario::Scenario small_bed() { return test::small_tilted_bed(1.0); }

/// Gives commands at certain steps: during deposition, twice at one step, and during the tilt.
void meddle(Session& session, std::int64_t step, std::int64_t tilt_began) {
  if (step == 20) session.apply({0, CommandKind::push, 4, 0.2, 0.3});
  if (step == 40) session.apply({0, CommandKind::friction, -1, 0.3, 0.0});
  if (step == 40) session.apply({0, CommandKind::tilt_rate, -1, 10.0, 0.0});
  if (tilt_began < 0) return;
  if (step == tilt_began) session.apply({0, CommandKind::drop, 3, 0.02, 0.01});
  if (step == tilt_began + 30) session.apply({0, CommandKind::tilt_rate, -1, 35.0, 0.0});
  if (step == tilt_began + 40) session.apply({0, CommandKind::push, 17, -0.4, 0.0});
  if (step == tilt_began + 40) session.apply({0, CommandKind::friction, -1, 0.7, 0.0});
}

/// Runs the small bed with these commands, to its end or for a number of steps. With a store, it commits
/// every `commit_every` steps and recreates the session from its checkpoint.
struct CommandedRun {
  std::optional<Session> session;
  std::vector<Command> commands;
};
CommandedRun commanded_run(std::int64_t steps, io::RunStore* store = nullptr,
                           std::int64_t commit_every = 100) {
  CommandedRun run;
  run.session.emplace(small_bed());
  std::int64_t tilt_began = -1;
  while (true) {
    Session& session = *run.session;
    const std::int64_t step = session.world().step;
    if (tilt_began < 0 && session.phase() == Phase::tilt) tilt_began = step;
    if (session.phase() != Phase::done) meddle(session, step, tilt_began);
    const bool ends = session.phase() == Phase::done || step >= steps;
    if (store != nullptr && (ends || step % commit_every == 0)) {
      const io::Segment& segment = session.segment();
      run.commands.insert(run.commands.end(), segment.commands.begin(), segment.commands.end());
      store->commit(segment, session.checkpoint(0.0));
      const io::Checkpoint checkpoint = session.checkpoint(0.0);
      run.session.emplace(small_bed(), checkpoint);
    } else if (ends) {
      run.commands = session.segment().commands;
    }
    if (ends) return run;
    run.session->advance();
  }
}

using test::to_the_end;

class Replay : public test::FolderTest {
 protected:
  /// Expects a stored run to be repeated to the bits of its last state.
  static void expect_repeated(const io::RunFile& stored) {
    Session again(small_bed());
    replay(again, nullptr, stored.commands(), stored.checkpoint().world.step, {});
    EXPECT_EQ(state_hash(again.world()), state_hash(stored.checkpoint().world));
  }

  const std::string path = folder.path("run.h5");
  const io::RunHeader header = run_header(Session(small_bed()), {});
};

TEST_F(Replay, of_a_run_with_commands_gives_the_same_bits) {
  const CommandedRun run = commanded_run(to_the_end);
  ASSERT_EQ(run.commands.size(), 7u) << "every command was given";
  const std::int64_t steps = run.session->world().step;
  Session again(small_bed());
  EXPECT_EQ(replay(again, nullptr, run.commands, steps, {}), RunEnd::complete);
  EXPECT_EQ(state_hash(again.world()), state_hash(run.session->world()));
  for (std::size_t k = 0; k < run.commands.size(); ++k) {
    std::vector<Command> others = run.commands;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
    Session other(small_bed());
    replay(other, nullptr, others, steps, {});
    EXPECT_NE(state_hash(other.world()), state_hash(run.session->world()))
        << "without " << command_text(run.commands[k]);
  }
}

TEST_F(Replay, of_a_run_that_was_resumed_again_and_again_gives_the_same_bits) {
  const CommandedRun whole = commanded_run(to_the_end);
  io::RunStore store = io::RunStore::create(path, header, false);
  const CommandedRun parts = commanded_run(to_the_end, &store);
  EXPECT_EQ(state_hash(parts.session->world()), state_hash(whole.session->world()));
  store.pack();
  const io::RunFile stored = io::RunFile::open(path);
  EXPECT_EQ(stored.commands(), whole.commands);
  expect_repeated(stored);
}

/// The last command was given after the last step, so that its effect is only in the checkpoint.
TEST_F(Replay, of_a_run_that_was_left_gives_the_same_bits) {
  {
    io::RunStore store = io::RunStore::create(path, header, false);
    commanded_run(20, &store);
  }
  const io::RunFile left = io::RunFile::open(path);
  ASSERT_EQ(left.commands().size(), 1u);
  ASSERT_EQ(left.commands().front().step, left.checkpoint().world.step);
  expect_repeated(left);
}

TEST_F(Replay, is_kept_as_the_run_it_was) {
  const CommandedRun run = commanded_run(to_the_end);
  const std::int64_t steps = run.session->world().step;
  Session again(small_bed());
  io::RunStore store = io::RunStore::create(path, header, false);
  replay(again, &store, run.commands, steps, {});
  const io::RunFile stored = io::RunFile::open(path);
  EXPECT_TRUE(stored.complete());
  EXPECT_EQ(stored.commands(), run.commands);
  EXPECT_EQ(stored.steps().size(), static_cast<std::size_t>(steps));
  EXPECT_EQ(stored.all_frame_tilts().size(), run.session->segment().frames.size());
  EXPECT_EQ(stored.all_observables(), run.session->segment().observables);
}

TEST_F(Replay, stops_when_asked) {
  volatile std::sig_atomic_t stop = 0;
  RunControl control;
  control.stop = &stop;
  control.on_step = [&stop](const RunProgress& progress) {
    if (progress.session.world().step == 3) stop = 1;
  };
  Session session(small_bed());
  EXPECT_EQ(replay(session, nullptr, {}, 10, control), RunEnd::stopped);
  EXPECT_EQ(session.world().step, 3);
}

/// A bed that does not come to rest in time ends with an error after a complete step, and is stored in this
/// state.
TEST_F(Replay, of_a_run_that_ended_with_an_error_gives_the_same_bits) {
  scenario::Scenario scenario = small_bed();
  scenario.deposition.max_time = 0.05;
  Session session(scenario);
  EXPECT_THROW(while (true) session.advance(), Error);
  Session again(scenario);
  EXPECT_EQ(replay(again, nullptr, {}, session.world().step, {}), RunEnd::complete);
  EXPECT_EQ(state_hash(again.world()), state_hash(session.world()));
  Session farther(scenario);
  EXPECT_THROW(replay(farther, nullptr, {}, session.world().step + 1, {}), Error);
}

/// The problem of the step after a frame takes earlier commands into account.
TEST_F(Replay, of_a_run_with_commands_has_the_problem_of_its_next_step) {
  scenario::Scenario scenario = small_bed();
  scenario.tilt.end_angle = 2.0;
  Session session(scenario);
  io::RunStore store = io::RunStore::create(path, run_header(session, {}), false);
  while (session.world().tilt < radians(0.999)) session.advance();
  session.apply({0, CommandKind::friction, -1, 0.3, 0.0});
  session.apply({0, CommandKind::tilt_rate, -1, 10.0, 0.0});
  while (session.world().tilt < radians(1.255)) session.advance();
  store.commit(session.segment(), session.checkpoint(0.0));
  const io::RunFile run = io::RunFile::open(path);
  const auto friction = [&run](std::size_t k) {
    return problems::problem_after_frame(run, k).problem.mu.front();
  };
  ASSERT_EQ(run.frame_count(), 4u) << "at 0, 0.5, 1 and 1.25 deg";
  EXPECT_EQ(friction(1), 0.5);
  EXPECT_EQ(friction(2), 0.3) << "given at this step";
  EXPECT_EQ(friction(3), 0.3);
  EXPECT_NEAR(degrees(problems::problem_after_frame(run, 1).scales.tilt - run.frame(1).tilt), 0.02, 1e-9);
  EXPECT_NEAR(degrees(problems::problem_after_frame(run, 3).scales.tilt - run.frame(3).tilt), 0.01, 1e-9);
}

/// A run without commands stores no such values.
TEST(Checkpoint, has_what_commands_changed_and_only_that) {
  Session session(small_bed());
  const auto count = [](const Session& subject) {
    const io::Checkpoint checkpoint = subject.checkpoint(0.0);
    return checkpoint.integers.size() + checkpoint.reals.size();
  };
  const std::size_t plain = count(session);
  session.apply({0, CommandKind::push, 4, 0.2, 0.3});
  EXPECT_EQ(count(session), plain);
  session.apply({0, CommandKind::friction, -1, 0.3, 0.0});
  EXPECT_EQ(count(session), plain + 1);
  session.apply({0, CommandKind::tilt_rate, -1, 7.0, 0.0});
  const Session taken_up(small_bed(), session.checkpoint(0.0));
  EXPECT_EQ(taken_up.law().friction, 0.3);
  EXPECT_EQ(taken_up.tilt_rate(), radians(7.0));
  const Session plainly(small_bed(), Session(small_bed()).checkpoint(0.0));
  EXPECT_EQ(plainly.law().friction, 0.5);
  EXPECT_EQ(plainly.tilt_rate(), radians(20.0));
}

}  // namespace
}  // namespace talus::session
