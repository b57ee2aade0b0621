/// Replays that continue from one of their frames, and runs in which commands are undone.

#include <gtest/gtest.h>

#include "base/errors.h"
#include "base/hash.h"
#include "io/run_file.h"
#include "opened_view.h"
#include "session/run.h"
#include "session/run_check.h"
#include "session/run_header.h"
#include "support/exit_code.h"
#include "support/recorded_run.h"
#include "support/small_bed.h"
#include "support/temporary_folder.h"

namespace talus::view {
namespace {

/// Returns the status after `count` further steps, for which it waits.
LiveStatus after_steps(LiveRun& run, std::int64_t count) {
  run.step(count);
  while (run.status().running) std::this_thread::yield();
  return run.status();
}

Command push(double x) { return {0, CommandKind::push, 3, x, 0.1}; }

LiveRun live(const std::string& output = "") {
  return LiveRun(test::small_tilted_bed(2.0), "seed = 1\n", output, false, "test");
}

TEST(Back, is_to_the_bit_before_the_command_as_often_as_one_likes) {
  LiveRun run = live();
  const LiveStatus before = after_steps(run, 30);
  run.apply(push(0.3));
  const std::string pushed = after_steps(run, 40).state_hash;
  EXPECT_EQ(run.commands().size(), 1u);
  for (int time = 0; time < 3; ++time) {
    run.back("");
    EXPECT_EQ(run.status().state_hash, before.state_hash);
    EXPECT_EQ(run.status().step, 30);
    EXPECT_TRUE(run.commands().empty());
    run.apply(push(0.3));
    EXPECT_EQ(after_steps(run, 40).state_hash, pushed);
  }
  run.back("");
  run.apply(push(0.4));
  EXPECT_NE(after_steps(run, 40).state_hash, pushed);
  run.apply({0, CommandKind::friction, -1, 0.2});
  run.back("");
  run.back("");
  EXPECT_EQ(run.status().state_hash, before.state_hash) << "one command after another";
  EXPECT_EQ(run.status().commands_given, 0u);
  EXPECT_EQ(test::exit_code_of([&] { run.back(""); }), ExitCode::usage);
}

TEST(Back, takes_a_drag_back_as_a_whole) {
  LiveRun run = live();
  const std::string before = after_steps(run, 30).state_hash;
  const double x = run.newest()->x[3], y = run.newest()->y[3];
  for (int k = 1; k < 5; ++k) {
    run.apply({0, CommandKind::drag, 3, x, y + 0.005 * k});
    after_steps(run, 3);
  }
  EXPECT_EQ(run.status().dragged, 3);
  run.apply({0, CommandKind::release});
  EXPECT_FALSE(run.status().dragged);
  after_steps(run, 5);
  EXPECT_EQ(run.status().commands_given, 1u);
  EXPECT_EQ(run.commands().size(), 5u);
  run.back("");
  EXPECT_EQ(run.status().state_hash, before);
}

/// The recorded file stays unchanged, and the continuation is a complete run in another file.
TEST(Back, of_a_recorded_run_goes_on_in_another_file) {
  const test::TemporaryFolder folder;
  const std::string one = folder.path("one.h5"), other = folder.path("other.h5");
  std::string end;
  {
    LiveRun run = live(one);
    after_steps(run, 30);
    run.apply(push(0.3));
    after_steps(run, 500);
    run.back(other);
    end = after_steps(run, 600).state_hash;
  }
  const io::RunFile first = io::RunFile::open(one), second = io::RunFile::open(other);
  EXPECT_EQ(first.commands().size(), 1u);
  EXPECT_TRUE(second.commands().empty());
  EXPECT_TRUE(session::check_run(second, {}).faults.empty());
  for (const io::RunFile* run : {&first, &second}) {
    session::Session again = session::session_at_start(run->header(), "run");
    session::replay(again, nullptr, run->commands(), run->checkpoint().world.step, {});
    EXPECT_EQ(state_hash(again.world()), state_hash(run->checkpoint().world));
  }
}

/// A replay of a recorded run.
class BranchView : public test::FolderTest {
 protected:
  BranchView() { test::recorded(test::small_tilted_bed(3.0), path); }

  const std::string path = folder.path("run.h5");
};

TEST_F(BranchView, goes_on_from_the_frame_shown_and_is_saved_as_a_run) {
  ViewModel model = example::opened(path);
  model.go_to(std::size_t{3});
  const Frame shown = model.frame();
  model.branch();
  ASSERT_TRUE(model.is_live());
  EXPECT_EQ(model.frame().step, shown.step);
  EXPECT_EQ(model.frame_count(), 1u) << "the frame with which it begins";
  ASSERT_TRUE(model.origin());
  EXPECT_EQ(model.origin()->frame, 3);
  EXPECT_EQ(model.origin()->start.world.tilt, shown.tilt);
  EXPECT_TRUE(model.may_discard()) << "nothing has been done yet";
  EXPECT_EQ(model.state.run_path, folder.path("run-branch-1.h5"));
  model.live()->apply(push(0.3));
  after_steps(*model.live(), 60);
  model.update(0.0);
  EXPECT_GT(model.frame_count(), 1u);
  EXPECT_FALSE(model.may_discard());
  model.back();
  EXPECT_EQ(model.frame().step, shown.step);
  EXPECT_EQ(model.frame_count(), 1u);
  model.live()->apply(push(0.2));
  const std::string hash = after_steps(*model.live(), 60).state_hash;
  model.record(model.state.run_path);
  { const ViewModel ended = std::move(model); }
  const io::RunFile branch = io::RunFile::open(folder.path("run-branch-1.h5"));
  EXPECT_EQ(hash_text(state_hash(branch.checkpoint().world)), hash);
  ASSERT_TRUE(branch.header().branch);
  EXPECT_EQ(branch.header().branch->run, path);
  EXPECT_EQ(branch.header().branch->frame, 3);
  EXPECT_EQ(branch.header().branch->start.world.step, shown.step);
  EXPECT_EQ(branch.header().branch->run_hash,
            hash_text(state_hash(io::RunFile::open(path).checkpoint().world)));
  session::Session again = session::session_at_start(branch.header(), "branch");
  session::replay(again, nullptr, branch.commands(), branch.checkpoint().world.step, {});
  EXPECT_EQ(hash_text(state_hash(again.world())), hash);
}

TEST_F(BranchView, has_the_friction_that_a_command_had_set) {
  const std::string commanded = folder.path("commanded.h5");
  {
    LiveRun run = live(commanded);
    after_steps(run, 30);
    run.apply({0, CommandKind::friction, -1, 0.2});
    after_steps(run, 500);
  }
  ViewModel model = example::opened(commanded);
  const ContactKey contact = key_of(model.frame().contacts, 0);
  model.select(contact);
  model.go_to(model.frame_count() - 2);
  EXPECT_EQ(model.contact_inspection()->friction, 0.2);
  model.branch();
  EXPECT_EQ(model.contact_inspection()->friction, 0.2);
  model.live()->apply({0, CommandKind::friction, -1, 0.3});
  after_steps(*model.live(), 10);
  model.update(0.0);
  EXPECT_EQ(model.contact_inspection()->friction, 0.3);
  model.back();
  model.record(folder.path("branch.h5"));
  { const ViewModel ended = std::move(model); }
  model = example::opened(folder.path("branch.h5"));
  model.select(contact);
  EXPECT_EQ(model.contact_inspection()->friction, 0.2);
}

TEST_F(BranchView, is_reset_to_the_frame_that_it_left) {
  ViewModel model = example::opened(path);
  model.go_to(std::size_t{2});
  model.branch();
  const std::string before = model.live()->status().state_hash;
  model.live()->apply(push(0.3));
  after_steps(*model.live(), 10);
  model.restart(7);
  EXPECT_EQ(model.live()->status().state_hash, before);
}

TEST_F(BranchView, stays_a_replay_where_the_run_ends) {
  ViewModel model = example::opened(path);
  model.go_to(Landmark::last);
  EXPECT_EQ(test::exit_code_of([&] { model.branch(); }), ExitCode::usage);
  EXPECT_FALSE(model.is_live());
  EXPECT_TRUE(
      example::wait_for_condition(model, [&] { return model.place_of(Landmark::first).has_value(); }));
}

}  // namespace
}  // namespace talus::view
