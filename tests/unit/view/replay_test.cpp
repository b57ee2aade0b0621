/// Playback of a run file with frames at 0, 5 ... 25 deg, then two of a flow.

#include <gtest/gtest.h>

#include "support/exit_code.h"
#include "support/temporary_folder.h"
#include "unit/io/example_run.h"
#include "unit/view/example_bed.h"
#include "view/frame_source.h"

namespace talus::view {
namespace {

class ReplayOfBed : public testing::Test {
 protected:
  ReplayOfBed() {
    example::write_bed_run(folder_.path("run.h5"), 20.0);
    replay_.emplace(folder_.path("run.h5"));
    replay_->set_speed(5.0);  // one frame per second
  }
  test::TemporaryFolder folder_;
  std::optional<Replay> replay_;
};

TEST_F(ReplayOfBed, moves_only_while_it_plays) {
  EXPECT_EQ(replay_->count(), 8u);
  EXPECT_FALSE(replay_->advance(10.0));
  EXPECT_EQ(replay_->index(), 0u);
  replay_->play(true);
  EXPECT_FALSE(replay_->advance(0.5));
  EXPECT_TRUE(replay_->advance(0.75));
  EXPECT_EQ(replay_->index(), 1u);
  EXPECT_TRUE(replay_->advance(2.0));  // includes the remaining quarter of a second
  EXPECT_EQ(replay_->index(), 3u);
  replay_->play(false);
  EXPECT_FALSE(replay_->advance(10.0));
}

TEST_F(ReplayOfBed, goes_at_its_speed) {
  replay_->set_speed(10.0);
  replay_->play(true);
  replay_->advance(1.0);
  EXPECT_EQ(replay_->index(), 2u);
  replay_->set_speed(-1.0);
  EXPECT_GT(replay_->speed(), 0.0);
}

TEST_F(ReplayOfBed, plays_a_flow_as_evenly_as_the_tilt_and_stops_at_its_end) {
  replay_->go_to(5);
  replay_->play(true);
  EXPECT_TRUE(replay_->advance(1.25));
  EXPECT_EQ(replay_->index(), 6u);
  EXPECT_TRUE(replay_->playing());
  EXPECT_TRUE(replay_->advance(10.0));
  EXPECT_EQ(replay_->index(), 7u);
  EXPECT_FALSE(replay_->playing());
  replay_->play(true);
  EXPECT_EQ(replay_->index(), 0u) << "from the beginning again";
}

TEST_F(ReplayOfBed, shows_a_frame_as_long_as_the_tilt_takes_to_the_next) {
  const std::string path = folder_.path("uneven.h5");
  example::write_run(path, 20.0,
                     {example::bed_frame(0.0, 0), example::bed_frame(1.0, 0), example::bed_frame(5.0, 0)});
  Replay replay(path);
  replay.set_speed(1.0);
  replay.play(true);
  EXPECT_TRUE(replay.advance(1.5));
  EXPECT_EQ(replay.index(), 1u);
  EXPECT_FALSE(replay.advance(3.0));
  EXPECT_TRUE(replay.advance(1.0));
}

TEST_F(ReplayOfBed, stays_within_the_run) {
  replay_->go_to(100);
  EXPECT_EQ(replay_->index(), 7u);
}

TEST_F(ReplayOfBed, keeps_the_frames_asked_for_last) {
  const auto first = replay_->frame(0);
  EXPECT_EQ(replay_->frame(3)->gamma[30], 1.0);
  EXPECT_EQ(replay_->frame(0), first) << "read again";
  EXPECT_EQ(replay_->frame(2)->gamma[30], 0.0);
  const auto read_elsewhere = std::make_shared<const Frame>(example::bed_frame(5.0, 1));
  replay_->keep(1, read_elsewhere);
  EXPECT_EQ(replay_->frame(1), read_elsewhere);
  EXPECT_EQ(replay_->frame(0), first);
  const auto third = replay_->frame(3);
  for (int k = 0; k < 60000; ++k)
    replay_->frame(0);  // more often than the cache has room for frames of this bed
  EXPECT_EQ(replay_->frame(3), third) << "a repeated request takes no more memory";
}

TEST_F(ReplayOfBed, keeps_two_frames_of_the_largest_beds) {
  Frame of_three_million;
  of_three_million.x.resize(3'000'000);
  const auto large = std::make_shared<const Frame>(std::move(of_three_million));
  for (const std::size_t k : {0u, 1u, 2u}) replay_->keep(k, large);
  EXPECT_EQ(replay_->frame(2), large);
  EXPECT_EQ(replay_->frame(1), large);
  EXPECT_NE(replay_->frame(0), large) << "read again";
}

TEST(ReplayOfNothing, says_that_there_are_no_frames) {
  const test::TemporaryFolder folder;
  io::RunStore store = io::RunStore::create(folder.path("run.h5"), example::header(), true);
  store.commit({}, example::checkpoint(0));
  EXPECT_TRUE(
      test::refuses([&] { const Replay replay(folder.path("run.h5")); }, ExitCode::bad_data, {"no frames"}));
}

}  // namespace
}  // namespace talus::view
