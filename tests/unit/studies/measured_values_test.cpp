/// Values read from a hand-made analysis with frames at 0, 5, 10, 15, 20 and 25 deg and failure at 21 deg.

#include "studies/measured_values.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/trigonometry.h"
#include "support/blank_analysis.h"

namespace talus::studies {
namespace {

using enum PaperQuantity;

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t frames = 6;
constexpr double diameter = 0.01;

struct HandMadeRun {
  std::vector<double> tilts;
  analysis::Analysis analysis = test::blank_analysis({.frames = frames, .thresholds = 2, .sections = 4});

  HandMadeRun() {
    for (std::size_t k = 0; k < frames; ++k) tilts.push_back(radians(5.0 * static_cast<double>(k)));
    set(&analysis::Analysis::theta_c, 0, radians(21.0));
    set(&analysis::Analysis::failure_ratio, 0, 0.7);
    for (std::size_t k = 0; k < frames; ++k) {
      const double number = static_cast<double>(k);
      set(&analysis::FrameRecord::volume_strain, k, 1e-3 * (number == 2 ? -2.0 : number));
      set(&analysis::FrameRecord::solid_fraction, k, 0.8 + 0.01 * number);
      set(&analysis::FrameRecord::stress_ratio, k, 0.5 * std::sin(tilts[k]));
      for (std::size_t f = 0; f < 2; ++f) {
        const double shift = f == 0 ? 0.0 : -0.2;
        set(&analysis::FrameThreshold::overloaded_fraction, 2 * k + f, 0.5 + shift + 0.01 * number);
        set(&analysis::FrameThreshold::overloaded_fraction_of_all, 2 * k + f, 0.4 + shift + 0.01 * number);
        set(&analysis::FrameThreshold::lc_mean, 2 * k + f, diameter * (4.0 + number));
        set(&analysis::FrameThreshold::lc_max, 2 * k + f, diameter * (10.0 + 2.0 * number));
      }
    }
    set(&analysis::RunThreshold::lc_jump, 0, radians(15.0));
    set(&analysis::RunThreshold::lc_jump, 1, none);
    percolate(0, 0.0, none);
    percolate(1, radians(10.0), radians(5.0));
    dilate(radians(10.0), radians(8.0), radians(12.0));
  }

  void set(const analysis::QuantityMember& member, std::size_t index, double value) {
    const analysis::Quantity& quantity = analysis::quantity_of(member);
    auto numbers = std::get<std::vector<double>>(analysis::values_of(quantity, analysis));
    numbers.at(index) = value;
    analysis::set_values(quantity, numbers, analysis);
  }
  void percolate(std::size_t f, double tilt, double error) {
    set(&analysis::RunThreshold::percolation, f, tilt);
    set(&analysis::RunThreshold::percolation_error, f, error);
  }
  void dilate(double tilt, double low, double high) {
    set(&analysis::Analysis::dilation, 0, tilt);
    set(&analysis::Analysis::dilation_low, 0, low);
    set(&analysis::Analysis::dilation_high, 0, high);
  }
  runs::RunView measured() const {
    runs::RunView run;
    run.statics.mean_diameter = diameter;
    run.statics.length = 2.0;
    run.analysis = analysis;
    for (std::size_t k = 0; k < tilts.size(); ++k) run.analysis.frames[k].tilt = tilts[k];
    return run;
  }
  MeasuredValue value(PaperQuantity quantity, std::size_t factor = 0,
                      Population population = Population::carrying) const {
    return measure(measured(), quantity, factor, population);
  }
};

TEST(MeasuredValue, at_0_is_that_of_the_first_frame) {
  const HandMadeRun run;
  EXPECT_DOUBLE_EQ(run.value(solid_fraction).value, 0.8);
  EXPECT_DOUBLE_EQ(run.value(overloaded_at_0).value, 0.5);
  EXPECT_DOUBLE_EQ(run.value(lc_mean_at_0).value, 4.0) << "in D";
  EXPECT_DOUBLE_EQ(run.value(lc_max_at_0).value, 10.0);
}

TEST(MeasuredValue, at_theta_c_is_that_of_the_last_frame_before_the_flow) {
  const HandMadeRun run;
  EXPECT_NEAR(run.value(theta_c).value, 21.0, 1e-12);
  EXPECT_DOUBLE_EQ(run.value(overloaded_at_theta_c).value, 0.54) << "at 20 deg, not at 25";
  EXPECT_DOUBLE_EQ(run.value(lc_mean_at_theta_c).value, 8.0);
  EXPECT_DOUBLE_EQ(run.value(volume_strain_at_theta_c).value, 4e-3);
}

TEST(MeasuredValue, at_theta_d_stands_on_either_side_of_the_jump) {
  const HandMadeRun run;
  EXPECT_NEAR(run.value(theta_d_by_jump).value, 15.0, 1e-12);
  EXPECT_DOUBLE_EQ(run.value(lc_max_before_jump).value, 14.0);
  EXPECT_DOUBLE_EQ(run.value(lc_max_after_jump).value, 16.0);
  EXPECT_DOUBLE_EQ(run.value(overloaded_at_theta_d).value, 0.53);
  EXPECT_DOUBLE_EQ(run.value(lc_mean_at_theta_d).value, 7.0);
  EXPECT_TRUE(std::isnan(run.value(lc_max_before_jump, 1).value)) << "no jump with the other threshold";
  EXPECT_TRUE(std::isnan(run.value(overloaded_at_theta_d, 1).value));
}

TEST(MeasuredValue, after_the_jump_is_cut_as_in_the_paper) {
  HandMadeRun run;
  run.set(&analysis::FrameThreshold::lc_max, 2 * 3, 36.0 * diameter);
  EXPECT_DOUBLE_EQ(run.value(lc_max_after_jump).value, 30.0);
}

TEST(MeasuredValue, of_the_other_threshold_is_its_own) {
  const HandMadeRun run;
  EXPECT_DOUBLE_EQ(run.value(overloaded_at_0, 1).value, 0.3);
  EXPECT_TRUE(std::isnan(run.value(overloaded_at_0, 2).value)) << "there is no third one";
}

TEST(MeasuredValue, over_all_grains_is_another_share) {
  const HandMadeRun run;
  EXPECT_DOUBLE_EQ(run.value(overloaded_at_0, 0, Population::all).value, 0.4);
  EXPECT_DOUBLE_EQ(run.value(overloaded_at_percolation, 1, Population::all).value, 0.22);
}

TEST(MeasuredValue, at_percolation_is_a_bound_where_it_spans_from_the_first_frame_on) {
  const HandMadeRun run;
  EXPECT_DOUBLE_EQ(run.value(theta_d_by_percolation, 1).value, 10.0);
  EXPECT_FALSE(run.value(theta_d_by_percolation, 1).at_most);
  EXPECT_DOUBLE_EQ(run.value(overloaded_at_percolation, 1).value, 0.32);
  EXPECT_DOUBLE_EQ(run.value(theta_d_by_percolation, 0).value, 0.0);
  EXPECT_TRUE(run.value(theta_d_by_percolation, 0).at_most);
  EXPECT_TRUE(run.value(overloaded_at_percolation, 0).at_most);
}

TEST(MeasuredValue, where_it_never_percolates_is_none) {
  HandMadeRun run;
  run.percolate(1, none, none);
  EXPECT_TRUE(std::isnan(run.value(theta_d_by_percolation, 1).value));
  EXPECT_TRUE(std::isnan(run.value(overloaded_at_percolation, 1).value));
}

TEST(Volume, contracts_and_dilates) {
  const HandMadeRun run;
  EXPECT_NEAR(run.value(theta_d_by_dilation).value, 10.0, 1e-12);
  EXPECT_DOUBLE_EQ(run.value(contraction).value, 2e-3);
  EXPECT_DOUBLE_EQ(run.value(dilation).value, 6e-3);
}

TEST(Volume, that_does_not_contract_by_more_than_noise_has_a_bound_for_its_onset) {
  HandMadeRun run;
  run.dilate(radians(2.0), 0.0, radians(9.0));
  EXPECT_TRUE(std::isnan(run.value(contraction).value));
  EXPECT_NEAR(run.value(theta_d_by_dilation).value, 9.0, 1e-12) << "the end of the range, not its minimum";
  EXPECT_TRUE(run.value(theta_d_by_dilation).at_most);
  EXPECT_GT(run.value(dilation).value, 0.0);
}

TEST(Volume, that_never_rises_has_no_dilation) {
  HandMadeRun run;
  run.dilate(none, none, none);
  EXPECT_TRUE(std::isnan(run.value(dilation).value));
  EXPECT_TRUE(std::isnan(run.value(theta_d_by_dilation).value));
  EXPECT_DOUBLE_EQ(run.value(contraction).value, -4e-3) << "up to theta_c, where the volume had grown";
}

TEST(Ratios, are_means_over_the_last_half_degree) {
  HandMadeRun run;
  EXPECT_NEAR(run.value(shear_over_tangent).value, 0.7, 1e-12);
  EXPECT_NEAR(run.value(shear_over_tangent_of_walls).value, 0.7, 1e-12);
  run.tilts = {0.0, radians(10.0), radians(20.4), radians(20.6), radians(20.9), radians(22.0)};
  const double factor[] = {0.0, 0.1, 0.2, 0.6, 0.8, 0.3};
  for (std::size_t k = 1; k < frames; ++k)
    run.set(&analysis::FrameRecord::stress_ratio, k, factor[k] * std::sin(run.tilts[k]));
  EXPECT_NEAR(run.value(stress_ratio_over_sine).value, 0.7, 1e-12);
}

TEST(Gradient, is_positive_where_the_lower_half_carries_more) {
  HandMadeRun run;
  const double sections[] = {1.0, 1.0, 3.0, 3.0};
  for (std::size_t x = 0; x < 4; ++x)
    run.set(&analysis::FrameRecord::section_sigma_xx, 4 * 4 + x, sections[x]);
  EXPECT_DOUBLE_EQ(run.value(wall_gradient).value, 1.0);
}

TEST(Directions, near_180_deg_are_near_0) {
  HandMadeRun run;
  run.set(&analysis::FrameRecord::direction_peak, 0, radians(177.0));
  run.set(&analysis::FrameRecord::direction_peak, 1, radians(61.0));
  EXPECT_NEAR(run.value(normals_near_0).value, -3.0, 1e-12);
  EXPECT_NEAR(run.value(normals_near_60).value, 61.0, 1e-12);
}

TEST(MeasuredValue, of_a_slope_that_stands_is_none) {
  HandMadeRun run;
  run.set(&analysis::Analysis::theta_c, 0, none);
  for (const MeasuredValue& measured : measure_all(run.measured(), 0, Population::carrying))
    EXPECT_TRUE(std::isnan(measured.value));
}

TEST(WallPoint, has_the_height_of_the_bed_at_failure) {
  HandMadeRun run;
  run.set(&analysis::FrameRecord::volume, 4, 0.38);
  const WallPoint point = wall_point(run.measured());
  EXPECT_DOUBLE_EQ(point.depth_over_length, 0.38 / 4.0);
  EXPECT_NEAR(point.ratio, 0.7, 1e-12);
  run.set(&analysis::Analysis::theta_c, 0, none);
  EXPECT_TRUE(std::isnan(wall_point(run.measured()).ratio));
}

}  // namespace
}  // namespace talus::studies
