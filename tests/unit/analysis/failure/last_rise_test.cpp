/// Last rise of tilts that go up and down.

#include "analysis/failure/last_rise.h"

#include <gtest/gtest.h>

namespace talus::analysis {
namespace {

std::pair<std::size_t, std::size_t> rise(const std::vector<double>& tilts) {
  const SeriesPart part = last_rise(tilts);
  return {part.first, part.end};
}

using Part = std::pair<std::size_t, std::size_t>;

TEST(LastRise, is_all_of_what_never_falls_or_never_rises) {
  EXPECT_EQ(rise({}), Part(0, 0));
  EXPECT_EQ(rise({1}), Part(0, 1));
  EXPECT_EQ(rise({0, 1, 2, 3}), Part(0, 4));
  EXPECT_EQ(rise({0, 1, 1, 1, 3, 3}), Part(0, 6)) << "including its holds";
  EXPECT_EQ(rise({3, 2, 1}), Part(0, 3));
  EXPECT_EQ(rise({2, 2}), Part(0, 2));
}

TEST(LastRise, begins_where_the_tilt_was_lowest_and_ends_where_it_falls_again) {
  EXPECT_EQ(rise({0, 1, 2, 1, 0, 1, 2, 3}), Part(4, 8));
  EXPECT_EQ(rise({0, 1, 2, 1, 0, 0, 1, 2, 2, 1, 0, 0}), Part(4, 9)) << "including the holds at both ends";
  EXPECT_EQ(rise({0, 2, 1}), Part(0, 2));
}

TEST(LastRise, goes_by_the_magnitude_of_the_tilt) {
  EXPECT_EQ(rise({0, 2, 1, 0, -1, -2, -3}), Part(3, 7));
  EXPECT_EQ(rise({0, -2, -0.5, 1, 2}), Part(2, 5)) << "from the tilt nearest to 0";
  EXPECT_EQ(magnitudes(std::vector<double>{0, -2, -0.5, 1, 2}, {2, 5}), (std::vector<double>{0.5, 1, 2}));
}

TEST(LastRise, of_rows_is_as_if_the_bed_were_tilted_to_one_side) {
  std::vector<ObservableRow> rows(5);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    at(rows[k], Observable::tilt) = std::vector{0.0, 0.2, 0.0, -0.1, -0.2}[k];
    at(rows[k], Observable::sigma_t_over_n) = at(rows[k], Observable::tilt);
    at(rows[k], Observable::surface_displacement) = -1.0 - static_cast<double>(k);
    at(rows[k], Observable::volume_strain) = -0.5;
  }
  const std::vector<ObservableRow> rise = rows_of_last_rise(rows);
  ASSERT_EQ(rise.size(), 3u);
  EXPECT_EQ(at(rise[2], Observable::tilt), 0.2);
  EXPECT_EQ(at(rise[2], Observable::sigma_t_over_n), 0.2);
  EXPECT_EQ(at(rise[2], Observable::surface_displacement), 5.0);
  EXPECT_EQ(at(rise[2], Observable::volume_strain), -0.5);
}

TEST(LastRise, of_frames_tells_them_and_their_tilts) {
  std::vector<FrameRecord> frames(4);
  for (std::size_t k = 0; k < 4; ++k) frames[k].tilt = std::vector{0.2, -0.1, -0.2, -0.1}[k];
  const FramesOfRise rise = last_rise(frames);
  EXPECT_EQ(rise.first, 1u);
  EXPECT_EQ(rise.tilts, (std::vector<double>{0.1, 0.2}));
  EXPECT_EQ(rise.frames, (std::vector<const FrameRecord*>{&frames[1], &frames[2]}));
  EXPECT_TRUE(rise.mirrored_slope);
  frames[3].tilt = 0.3;
  EXPECT_FALSE(last_rise(frames).mirrored_slope);
}

TEST(LastRise, of_a_bed_that_slopes_to_the_other_side_is_mirrored) {
  FrameRecord frame;
  frame.sigma_t_over_n = -0.25;
  frame.stress_ratio = 0.5;
  frame.texture_axis = -1.2;
  const auto number = [&frame](const QuantityMember& member, bool mirrored_slope) {
    return number_on_one_side(quantity_of(member), frame, 0, mirrored_slope);
  };
  EXPECT_EQ(number(&FrameRecord::sigma_t_over_n, false), -0.25);
  EXPECT_EQ(number(&FrameRecord::sigma_t_over_n, true), 0.25);
  EXPECT_EQ(number(&FrameRecord::stress_ratio, true), 0.5);
  EXPECT_EQ(number(&FrameRecord::texture_axis, false), -1.2);
  EXPECT_EQ(number(&FrameRecord::texture_axis, true), 1.2);
}

}  // namespace
}  // namespace talus::analysis
