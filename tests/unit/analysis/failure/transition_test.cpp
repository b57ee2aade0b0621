/// theta_d from its three estimators, for hand-made series.

#include "analysis/failure/transition.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace talus::analysis {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
const std::vector<double> tilts = {0.0, 0.1, 0.2, 0.4, 0.5, 0.6};

const std::vector<double> lengths = {5.0, 6.0, 5.5, 15.0, 16.0, 30.0};
constexpr double cut = 40.0;

TEST(LengthJump, is_the_largest_increase) {
  const LengthJump jump = length_jump(tilts, lengths, 0.55, cut);
  EXPECT_EQ(jump.tilt, 0.4) << "30 comes after theta_c";
  EXPECT_DOUBLE_EQ(jump.error, 0.2);
  EXPECT_DOUBLE_EQ(jump.size, 9.5);
  EXPECT_EQ(length_jump(tilts, lengths, none, cut).tilt, 0.6);
  EXPECT_EQ(length_jump(tilts, lengths, 0.6, cut).tilt, 0.6) << "theta_c counts";
}

TEST(LengthJump, ends_where_the_length_reaches_the_cut) {
  EXPECT_EQ(length_jump(tilts, lengths, none, 15.0).tilt, 0.4) << "30 comes after the first that is cut off";
  EXPECT_TRUE(std::isnan(length_jump(tilts, lengths, none, 5.0).tilt)) << "cut off from the start";
}

TEST(LengthJump, of_a_length_that_never_increases_is_none) {
  for (const auto& falling :
       {std::vector(6, 20.0), std::vector{9.0, 8.0, 7.0, 6.0, 5.0, 4.0}, std::vector(6, none)})
    EXPECT_TRUE(std::isnan(length_jump(tilts, falling, none, cut).tilt));
}

TEST(LengthJump, is_not_seen_beside_a_frame_without_overloaded_grains) {
  EXPECT_EQ(length_jump(tilts, std::vector{none, 20.0, none, 5.0, 6.0, 6.0}, none, cut).tilt, 0.5);
}

TEST(FirstSlide, is_where_the_layer_begins_to_move_far_enough_within_the_window) {
  const std::vector<double> displacements = {0.0, 0.1, 0.2, 0.6, 0.7, 2.0};
  EXPECT_EQ(first_slide(tilts, displacements, 0.5, 0.35), 0.1) << "0.5 from 0.1 to 0.4";
  EXPECT_EQ(first_slide(tilts, displacements, 0.5, 0.15), 0.5) << "1.3 from 0.5 to 0.6";
  EXPECT_EQ(first_slide(tilts, displacements, 0.5, 1.0), 0.0);
}

TEST(FirstSlide, of_a_layer_that_creeps_or_moves_upslope_is_none) {
  EXPECT_TRUE(std::isnan(first_slide(tilts, std::vector{0.0, 0.1, 0.2, 0.3, 0.4, 0.49}, 0.5, 0.6)));
  EXPECT_TRUE(std::isnan(first_slide(tilts, std::vector{9.0, 8.0, 7.0, 6.0, 5.0, 4.0}, 0.5, 0.6)));
  EXPECT_TRUE(std::isnan(first_slide({}, {}, 0.5, 0.6)));
}

TEST(PercolationOnset, is_the_first_of_three_frames) {
  const PercolationOnset onset = percolation_onset(tilts, std::vector<Index>{0, 1, 0, 1, 1, 1}, none);
  EXPECT_EQ(onset.tilt, 0.4);
  EXPECT_DOUBLE_EQ(onset.error, 0.2);
}

TEST(PercolationOnset, may_last_beyond_theta_c_but_not_begin_there) {
  EXPECT_EQ(percolation_onset(tilts, std::vector<Index>{0, 1, 0, 1, 1, 1}, 0.4).tilt, 0.4);
  EXPECT_TRUE(std::isnan(percolation_onset(tilts, std::vector<Index>{0, 1, 0, 1, 1, 1}, 0.39).tilt));
}

TEST(PercolationOnset, of_a_bed_that_spans_from_the_start_has_no_frame_before_it) {
  const PercolationOnset onset = percolation_onset(tilts, std::vector<Index>{1, 1, 1, 0, 0, 0}, none);
  EXPECT_EQ(onset.tilt, 0.0);
  EXPECT_TRUE(std::isnan(onset.error));
}

TEST(PercolationOnset, of_short_spells_is_none) {
  EXPECT_TRUE(std::isnan(percolation_onset(tilts, std::vector<Index>{1, 1, 0, 0, 1, 1}, none).tilt));
  EXPECT_TRUE(std::isnan(percolation_onset(std::vector{0.0}, std::vector<Index>{1}, none).tilt));
}

/// Strain over 0 ... 20 deg in rows of 0.01 deg, with alternating noise.
struct Strain {
  std::vector<double> tilt, value;
};
template <typename Law>
Strain strain_of(const Law& law, double noise) {
  Strain strain;
  for (int i = 0; i <= 2000; ++i) {
    strain.tilt.push_back(0.01 * i);
    strain.value.push_back(law(0.01 * i) + (i % 2 == 0 ? noise : -noise));
  }
  return strain;
}

TEST(DilationOnset, is_the_minimum_of_the_strain_within_its_noise) {
  const double noise = 1e-4;
  const Strain strain = strain_of([](double t) { return 1e-4 * (t - 15.0) * (t - 15.0); }, noise);
  const DilationOnset onset = dilation_onset(strain.tilt, strain.value, none, 1.0);
  EXPECT_NEAR(onset.tilt, 15.0, 0.05);
  EXPECT_NEAR(onset.low, 14.0, 0.06) << "the parabola exceeds its minimum there by the noise";
  EXPECT_NEAR(onset.high, 16.0, 0.06);
}

TEST(DilationOnset, of_a_strain_that_only_falls_is_none) {
  for (const double noise : {0.0, 1e-4}) {
    const Strain strain = strain_of([](double t) { return -1e-4 * t * t; }, noise);
    EXPECT_TRUE(std::isnan(dilation_onset(strain.tilt, strain.value, none, 1.0).tilt)) << noise;
  }
}

TEST(DilationOnset, of_a_strain_that_only_rises_is_the_start_within_its_noise) {
  const Strain strain = strain_of([](double t) { return 1e-4 * t * t; }, 1e-4);
  const DilationOnset onset = dilation_onset(strain.tilt, strain.value, none, 1.0);
  EXPECT_LT(onset.tilt, 0.5);
  EXPECT_EQ(onset.low, 0.0);
  EXPECT_NEAR(onset.high, 1.0, 0.1);
}

TEST(DilationOnset, looks_no_further_than_theta_c) {
  const Strain strain = strain_of([](double t) { return 1e-4 * (t - 15.0) * (t - 15.0); }, 1e-4);
  EXPECT_TRUE(std::isnan(dilation_onset(strain.tilt, strain.value, 14.9, 1.0).tilt));
  EXPECT_FALSE(std::isnan(dilation_onset(strain.tilt, strain.value, 17.0, 1.0).tilt));
  EXPECT_TRUE(std::isnan(dilation_onset({}, {}, none, 1.0).tilt));
}

TEST(GrowthExponent, of_a_power_law_is_its_power) {
  const std::vector<double> at = {0.0, 10.0, 12.0, 14.0, 16.0, 18.0, 20.0, 21.0};
  std::vector<double> sizes;
  for (const double tilt : at) sizes.push_back(3.0 * std::pow(20.5 - tilt, -0.5));
  sizes[0] = 1e6;  // outside the window
  sizes[7] = 1e6;  // after theta_c
  sizes[3] = none;
  const GrowthExponent growth = growth_exponent(at, sizes, 20.5, 11.0);
  EXPECT_NEAR(growth.exponent, 0.5, 1e-12);
  EXPECT_NEAR(growth.error, 0.0, 1e-12);
  EXPECT_TRUE(std::isnan(growth_exponent(at, sizes, 20.5, 9.0).exponent)) << "four are too few";
  EXPECT_TRUE(std::isnan(growth_exponent(at, sizes, none, 9.0).error));
}

// x = ln 1, ln 2, ln 4, ln 8, ln 16: in units of ln 2, -2 ... 2 about the middle, with a sum of squares of
// 10. Raising the middle point by ln 32 keeps the slope and gives residuals of 4 for it and -1 for the
// others: 20 / 3 / 10.
TEST(GrowthExponent, has_the_standard_error_of_a_slope) {
  const std::vector<double> at = {-16.0, -8.0, -4.0, -2.0, -1.0};
  const GrowthExponent growth = growth_exponent(at, std::vector<double>{1.0, 1.0, 32.0, 1.0, 1.0}, 0.0, 16.0);
  EXPECT_NEAR(growth.exponent, 0.0, 1e-12);
  EXPECT_NEAR(growth.error, std::sqrt(2.0 / 3.0), 1e-12);
}

}  // namespace
}  // namespace talus::analysis
