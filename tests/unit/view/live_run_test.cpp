/// A run computed in a separate thread: bit-identical to an unobserved run, with consistent frames, and the
/// data left on disk.

#include "view/live_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <thread>

#include "base/errors.h"
#include "base/hash.h"
#include "core/trigonometry.h"
#include "io/run_file.h"
#include "session/measure.h"
#include "session/run.h"
#include "support/small_bed.h"
#include "support/temporary_folder.h"

namespace talus::view {
namespace {

/// Returns a bed of 30 grains that is tilted to 2 deg in some hundred steps.
scenario::Scenario small_bed() {
  scenario::Scenario scenario = test::small_tilted_bed(2.0);
  scenario.output.frame_every = 1.0;
  return scenario;
}

LiveRun live(const scenario::Scenario& scenario, const std::string& output = "") {
  return LiveRun(scenario, "seed = 1\n", output, false, "test");
}

/// Waits until the solver is paused, and returns its status.
LiveStatus paused(const LiveRun& run) {
  while (run.status().running) std::this_thread::sleep_for(std::chrono::microseconds(200));
  return run.status();
}

session::Session plain_run(std::int64_t steps) {
  session::Session session(small_bed());
  while (session.phase() != session::Phase::done && session.world().step < steps) session.advance();
  return session;
}

std::string hash_of(const session::Session& session) { return hash_text(state_hash(session.world())); }

/// Expects the frame to be that of the session: positions, contacts and stresses of the same step.
void expect_frame_of(const session::Session& session, const Frame& frame) {
  const Frame expected = session::make_frame(session.world(), session.law());
  EXPECT_EQ(frame.step, expected.step);
  EXPECT_EQ(frame.time, expected.time);
  EXPECT_EQ(frame.tilt, expected.tilt);
  EXPECT_EQ(frame.x, expected.x);
  EXPECT_EQ(frame.vy, expected.vy);
  EXPECT_EQ(frame.contacts.a, expected.contacts.a);
  EXPECT_EQ(frame.contacts.fn, expected.contacts.fn);
  EXPECT_EQ(frame.contacts.px, expected.contacts.px);
  EXPECT_EQ(frame.contacts.status, expected.contacts.status);
}

class LiveRunTest : public test::FolderTest {
 protected:
  /// Expects a stored run to be repeated to the bits of its last state.
  static void expect_repeated(const io::RunFile& stored) {
    session::Session again(small_bed());
    session::replay(again, nullptr, stored.commands(), stored.checkpoint().world.step, {});
    EXPECT_EQ(state_hash(stored.checkpoint().world), state_hash(again.world()));
  }

  const std::string path = folder.path("run.h5");
};

TEST_F(LiveRunTest, begins_paused_before_its_first_step) {
  const LiveRun run = live(small_bed());
  const LiveStatus status = run.status();
  EXPECT_EQ(status.step, 0);
  EXPECT_FALSE(status.running);
  EXPECT_TRUE(status.depositing);
  EXPECT_FALSE(status.done);
  EXPECT_FALSE(status.theta_c);
  EXPECT_EQ(status.tilt_rate, 20.0);
  EXPECT_EQ(status.friction, 0.5);
  EXPECT_EQ(status.state_hash, hash_of(session::Session(small_bed())));
  ASSERT_NE(run.newest(), nullptr);
  EXPECT_EQ(run.newest()->step, 0);
  EXPECT_EQ(run.newest()->grain_count(), 40) << "with its floor";
  EXPECT_EQ(run.statics().free_count, 30);
}

TEST_F(LiveRunTest, looked_at_all_the_time_gives_the_bits_of_a_plain_run) {
  LiveRun run = live(small_bed());
  run.play();
  while (run.status().running) {
    run.newest();
    run.observables(0);
  }
  const session::Session plain = plain_run(1'000'000);
  const LiveStatus status = run.status();
  EXPECT_TRUE(status.done);
  EXPECT_EQ(status.error, "");
  EXPECT_EQ(status.step, plain.world().step);
  EXPECT_EQ(status.state_hash, hash_of(plain));
  EXPECT_EQ(run.observables(0), plain.segment().observables);
  EXPECT_EQ(run.observables(3).size(), plain.segment().observables.size() - 3);
  run.take_frames();
  ASSERT_EQ(run.count(), plain.segment().frames.size());
  EXPECT_EQ(run.read(2)->step, plain.segment().frames[2].step);
  EXPECT_THROW(run.read(99), std::out_of_range);
}

/// Times are lower bounds, which hold on a busy machine too.
TEST_F(LiveRunTest, goes_no_faster_than_its_pace) {
  const auto seconds_of = [](LiveRun& run, std::int64_t steps) {
    const auto begin = std::chrono::steady_clock::now();
    run.step(steps);
    paused(run);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  LiveRun run = live(small_bed());
  const double h = scenario::time_step(small_bed());
  run.set_pace({"a tenth of real time", 0.0, 0.1});
  EXPECT_GE(seconds_of(run, 20), 18.0 * 10.0 * h);
  EXPECT_EQ(run.status().state_hash, hash_of(plain_run(20))) << "the bits are identical";
  run.set_pace({"0.5 deg/s", 0.5, 0.0});
  run.finish_deposition();
  paused(run);
  EXPECT_GE(seconds_of(run, 20), 18.0 * h * run.status().tilt_rate / 0.5);
  run.set_pace({"a step in an hour", 0.0, h / 3600.0});
  const std::int64_t before = run.status().step;
  run.play();
  while (run.status().step == before) std::this_thread::yield();
  run.pause();
  paused(run);
  run.apply({0, CommandKind::friction, -1, 0.4, 0.0});
  EXPECT_EQ(run.status().friction, 0.4) << "requests do not wait";
}

TEST_F(LiveRunTest, saved_late_is_recorded_from_its_beginning) {
  const std::string path = folder.path("late.h5");
  {
    LiveRun run = live(small_bed());
    run.finish_deposition();
    paused(run);
    run.apply({0, CommandKind::push, 3, 0.2, 0.1});
    run.step(5);
    paused(run);
    run.record(path);
    EXPECT_THROW(run.record(folder.path("other.h5")), Error);
    run.play();
    EXPECT_TRUE(paused(run).done);
  }
  session::Session same = plain_run(0);
  while (same.phase() == session::Phase::deposition) same.advance();
  same.apply({0, CommandKind::push, 3, 0.2, 0.1});
  while (same.phase() != session::Phase::done) same.advance();
  const io::RunFile run = io::RunFile::open(path);
  EXPECT_EQ(hash_text(state_hash(run.checkpoint().world)), hash_of(same));
  EXPECT_EQ(run.steps(), same.segment().steps);
  EXPECT_EQ(run.observables(), same.segment().observables);
  EXPECT_EQ(run.all_frame_tilts().size(), same.segment().frames.size());
  ASSERT_EQ(run.commands().size(), 1u);
  EXPECT_EQ(run.commands()[0].grain, 3);
}

TEST_F(LiveRunTest, that_cannot_be_saved_goes_on) {
  LiveRun run = live(small_bed());
  run.step(4);
  paused(run);
  std::ofstream(folder.path("file")) << "no folder";
  EXPECT_THROW(run.record(folder.path("file/late.h5")), Error);
  run.step(4);
  EXPECT_EQ(paused(run).step, 8);
  EXPECT_EQ(run.status().error, "");
  run.record(folder.path("late.h5"));
}

TEST_F(LiveRunTest, halted_rests_until_it_is_asked_to_go_on) {
  LiveRun run = live(small_bed());
  run.play();
  run.halt();
  const LiveStatus rests = run.status();
  EXPECT_FALSE(rests.running);
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_EQ(run.status().step, rests.step);
  run.step(1);
  EXPECT_EQ(paused(run).step, rests.step + 1);
}

TEST_F(LiveRunTest, takes_as_many_steps_as_asked_for) {
  LiveRun run = live(small_bed());
  for (const std::int64_t count : {1, 10, 30}) {
    run.step(count);
    paused(run);
  }
  const session::Session plain = plain_run(41);
  EXPECT_EQ(run.status().step, 41);
  EXPECT_EQ(run.status().state_hash, hash_of(plain));
  expect_frame_of(plain, *run.newest());
}

TEST_F(LiveRunTest, counts_the_steps_that_miss_their_tolerance) {
  scenario::Scenario scenario = small_bed();
  scenario.solver.max_iterations = 1;
  scenario.guards.action = scenario::GuardAction::warn;
  LiveRun run = live(scenario);
  EXPECT_FALSE(run.status().solved.last);
  run.step(200);
  const SolvedSteps solved = paused(run).solved;
  session::Session plain(scenario);
  while (plain.world().step < 200) plain.advance();
  EXPECT_EQ(solved.count, 200);
  EXPECT_GT(solved.unconverged, 0);
  EXPECT_EQ(solved.unconverged, plain.schedule().record.unconverged());
  EXPECT_EQ(solved.last, plain.segment().steps.back());
}

TEST_F(LiveRunTest, plays_to_the_end_of_the_deposition_and_to_a_tilt) {
  LiveRun run = live(small_bed());
  run.finish_deposition();
  LiveStatus status = paused(run);
  EXPECT_FALSE(status.depositing);
  EXPECT_EQ(status.tilt, 0.0);
  run.take_frames();
  EXPECT_EQ(run.count(), 1u) << "the state of the bed at rest";
  run.run_to(radians(1.0));
  status = paused(run);
  EXPECT_NEAR(degrees(status.tilt), 1.0, 1e-9);
  EXPECT_FALSE(status.done);
  run.run_to(radians(0.9));
  status = paused(run);
  EXPECT_NEAR(degrees(status.tilt), 0.9, 1e-9) << "from above, once the tilt is turned";
  EXPECT_LT(status.tilt_rate, 0.0);
  run.apply({0, CommandKind::tilt_rate, -1, 0.0});
  EXPECT_THROW(run.run_to(radians(0.5)), Error) << "the tilt is held";
  EXPECT_EQ(paused(run).step, status.step);
}

/// A frame taken from a running run equals that of a plain run after the same number of steps.
TEST_F(LiveRunTest, shows_frames_that_are_whole) {
  scenario::Scenario scenario = small_bed();
  scenario.tilt.end_angle = 60.0;
  LiveRun run = live(scenario);
  run.play();
  std::vector<std::shared_ptr<const Frame>> frames;
  while (frames.size() < 4) {
    const auto frame = run.newest();
    if (frames.empty() || frame != frames.back()) frames.push_back(frame);
  }
  run.pause();
  frames.push_back((paused(run), run.newest()));
  session::Session plain(scenario);
  for (const auto& frame : frames) {
    EXPECT_NEAR(frame->time, 1e-3 * static_cast<double>(frame->step), 1e-9);
    while (plain.world().step < frame->step) plain.advance();
    expect_frame_of(plain, *frame);
  }
  EXPECT_EQ(run.status().step, frames.back()->step);
  EXPECT_EQ(run.status().state_hash, hash_of(plain));
}

TEST_F(LiveRunTest, does_commands_while_it_goes_on_and_replays_to_the_same_bits) {
  scenario::Scenario scenario = small_bed();
  scenario.tilt.end_angle = 5.0;
  LiveRun run = live(scenario);
  run.step(5);
  run.apply({0, CommandKind::push, 3, 0.1, 0.2});
  run.finish_deposition();
  paused(run);
  run.apply({0, CommandKind::drop, 2, 0.03, 0.01});
  const auto dropped = run.newest();
  EXPECT_GT(*std::ranges::max_element(dropped->y), 0.03) << "the drop is visible at once";
  run.play();
  run.apply({0, CommandKind::tilt_rate, -1, 10.0, 0.0});
  run.apply({0, CommandKind::friction, -1, 0.8, 0.0});
  EXPECT_EQ(run.status().tilt_rate, 10.0);
  EXPECT_EQ(run.status().friction, 0.8);
  const LiveStatus end = paused(run);
  const std::vector<Command> commands = run.commands();
  ASSERT_EQ(commands.size(), 4u);
  EXPECT_EQ(commands[2].kind, CommandKind::tilt_rate);
  session::Session again(scenario);
  session::replay(again, nullptr, commands, end.step, {});
  EXPECT_EQ(end.state_hash, hash_of(again));
}

TEST_F(LiveRunTest, refuses_what_cannot_be_done_and_goes_on) {
  LiveRun run = live(small_bed());
  EXPECT_THROW(run.apply({0, CommandKind::push, 30, 0.1, 0.0}), Error);
  EXPECT_EQ(run.status().error, "");
  EXPECT_TRUE(run.commands().empty());
  run.play();
  const LiveStatus end = paused(run);
  EXPECT_TRUE(end.done);
  EXPECT_THROW(run.apply({0, CommandKind::push, 3, 0.1, 0.0}), Error);
  run.play();
  EXPECT_FALSE(run.status().running);
}

TEST_F(LiveRunTest, that_fails_says_why_and_keeps_its_state) {
  scenario::Scenario scenario = small_bed();
  scenario.deposition.max_time = 0.02;
  LiveRun run = live(scenario);
  run.play();
  const LiveStatus status = paused(run);
  EXPECT_NE(status.error.find("did not come to rest"), std::string::npos) << status.error;
  EXPECT_EQ(status.error_code, ExitCode::bad_data);
  EXPECT_EQ(status.step, 20);
  EXPECT_EQ(run.newest()->step, 20);
  EXPECT_EQ(status.state_hash, hash_of(plain_run(20)));
}

TEST_F(LiveRunTest, that_is_done_leaves_the_file_of_a_plain_run) {
  std::vector<Command> commands;
  {
    LiveRun run = live(small_bed(), path);
    run.apply({0, CommandKind::push, 3, 0.1, 0.2});
    run.play();
    paused(run);
    commands = run.commands();
  }
  const io::RunFile stored = io::RunFile::open(path);
  EXPECT_TRUE(stored.complete());
  EXPECT_EQ(stored.commands(), commands);
  EXPECT_EQ(stored.header().scenario_given, "seed = 1\n");
  expect_repeated(stored);
}

TEST_F(LiveRunTest, that_is_left_can_be_resumed) {
  {
    LiveRun run = live(small_bed(), path);
    run.finish_deposition();
    paused(run);
    run.step(3);
    paused(run);
    run.apply({0, CommandKind::friction, -1, 0.8, 0.0});
  }
  io::RunHeader header;
  io::Checkpoint checkpoint;
  io::RunStore store = io::RunStore::resume(path, header, checkpoint);
  session::Session resumed(small_bed(), checkpoint);
  EXPECT_EQ(resumed.law().friction, 0.8);
  EXPECT_EQ(session::run_to_end(resumed, store, {}), session::RunEnd::complete);
  const io::RunFile stored = io::RunFile::open(path);
  ASSERT_EQ(stored.commands().size(), 1u);
  expect_repeated(stored);
}

TEST_F(LiveRunTest, is_saved_when_asked) {
  LiveRun run = live(small_bed(), path);
  run.step(7);
  paused(run);
  EXPECT_EQ(io::run_presence(path), io::RunPresence::none);
  run.save();
  EXPECT_EQ(io::RunFile::open(path).checkpoint().world.step, 7);
  EXPECT_EQ(io::RunFile::open(path).steps().size(), 7u);
  EXPECT_THROW(live(small_bed(), path), Error) << "the file is locked, and exists";
}

TEST_F(LiveRunTest, that_cannot_write_says_so_and_tries_again) {
  LiveRun run = live(small_bed(), path);
  run.step(7);
  paused(run);
  const std::filesystem::path stored = io::run_folder(path), aside = folder.path("aside");
  std::filesystem::rename(stored, aside);
  run.save();
  EXPECT_NE(run.status().error.find("run.h5.run"), std::string::npos) << run.status().error;
  EXPECT_EQ(run.status().step, 7);
  std::filesystem::rename(aside, stored);
  run.step(1);
  paused(run);
  run.save();
  EXPECT_EQ(run.status().error, "");
  EXPECT_EQ(io::RunFile::open(path).steps().size(), 8u);
}

}  // namespace
}  // namespace talus::view
