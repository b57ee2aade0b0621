/// Selection of the frames that a movie shows.

#include "pictures/run_movie.h"

#include <gtest/gtest.h>

#include "core/trigonometry.h"

namespace talus::pictures {
namespace {

std::vector<double> rad(std::vector<double> angles) {
  for (double& angle : angles) angle = radians(angle);
  return angles;
}

/// Returns the frame of the run shown in each frame of the movie.
std::vector<std::size_t> shown(const std::vector<double>& clock, const MovieTiming& timing) {
  std::vector<std::size_t> frames;
  for (const MovieFrame& frame : movie_frames(clock, timing))
    frames.insert(frames.end(), static_cast<std::size_t>(frame.times), frame.frame);
  return frames;
}

TEST(MovieFrames, without_a_speed_each_is_shown_once) {
  MovieTiming timing;
  EXPECT_EQ(shown(rad({0, 1, 2, 2.1, 3}), timing), (std::vector<std::size_t>{0, 1, 2, 3, 4}));
  timing.every = 2.0;
  EXPECT_EQ(shown(rad({0, 1, 2, 3, 4}), timing), (std::vector<std::size_t>{0, 2, 4}));
}

TEST(MovieFrames, with_a_speed_each_shows_the_last_one_before_its_angle) {
  MovieTiming timing;
  timing.fps = 4.0;
  timing.speed = 2.0;  // half a degree per frame of the movie: 0, 0.5, 1, ...
  EXPECT_EQ(shown(rad({0, 1, 1.7, 2}), timing), (std::vector<std::size_t>{0, 0, 1, 1, 3, 3, 3, 3, 3}))
      << "the frame at 1.7 is never the last; the end is held for a second";
}

TEST(MovieFrames, stay_at_both_ends_where_that_is_asked_for) {
  MovieTiming timing;
  timing.fps = 2.0;
  timing.hold = 1.0;
  EXPECT_EQ(shown(rad({0, 1, 2}), timing), (std::vector<std::size_t>{0, 0, 0, 1, 2, 2, 2}));
  timing.speed = 2.0;
  EXPECT_EQ(shown(rad({0, 1, 2}), timing), (std::vector<std::size_t>{0, 0, 0, 1, 2, 2, 2}));
  EXPECT_EQ(shown(rad({0}), timing).size(), 3u) << "a single frame is the first and the last";
  timing.hold = 0.0;
  EXPECT_EQ(shown(rad({0, 1, 2}), timing), (std::vector<std::size_t>{0, 1, 2}));
}

TEST(MovieFrames, are_as_many_as_angle_and_speed_say) {
  MovieTiming timing;
  timing.fps = 30.0;
  timing.speed = 0.7;
  std::vector<double> clock;
  for (int k = 0; k <= 61; ++k) clock.push_back(0.25 * k);
  const auto frames = shown(rad(clock), timing);
  EXPECT_EQ(frames.size(), static_cast<std::size_t>(std::ceil(15.25 / 0.7 * 30.0)) + 1 + 30);
  for (std::size_t j = 0; j + 31 < frames.size(); ++j) {
    const double angle = static_cast<double>(j) * 0.7 / 30.0;
    EXPECT_LE(clock[frames[j]], angle + 1e-6);
    EXPECT_GT(clock[frames[j] + 1], angle - 1e-6);
  }
}

}  // namespace
}  // namespace talus::pictures
