/// Notifications to clients during a run.

#include "session/run.h"

#include <gtest/gtest.h>

#include "io/run_file.h"
#include "session/run_header.h"
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

TEST(RunToEnd, each_frame_is_shown_once_in_its_order) {
  const test::TemporaryFolder folder;
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

TEST(RunToEnd, a_frame_is_shown_before_it_is_committed) {
  const test::TemporaryFolder folder;
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

TEST(RunToEnd, stops_in_time_for_what_it_is_allowed) {
  EXPECT_FALSE(time_is_up(100.0, 98.9, 0.1));
  EXPECT_TRUE(time_is_up(100.0, 99.1, 0.1)) << "less than a hundredth remains";
  EXPECT_FALSE(time_is_up(100.0, 89.0, 5.0));
  EXPECT_TRUE(time_is_up(100.0, 91.0, 5.0)) << "two long steps would exceed it";
}

TEST(RunToEnd, told_to_stop_while_it_packs_it_stays_a_folder) {
  const test::TemporaryFolder folder;
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

}  // namespace
}  // namespace talus::session
