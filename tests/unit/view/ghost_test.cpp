/// Reference curves: a single run, or the mean and standard deviation of several.

#include "view/ghost.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/trigonometry.h"

namespace talus::view {
namespace {

const analysis::Quantity& strain() { return analysis::quantity_of(&analysis::FrameRecord::volume_strain); }
const analysis::Quantity& p_o() {
  return analysis::quantity_of(&analysis::FrameThreshold::overloaded_fraction);
}

/// Returns frames at each degree from 0 on, with a volume strain of `slope` times the angle in degrees.
GhostRun run_of(int frames, double slope, double theta_c) {
  GhostRun run;
  for (int k = 0; k < frames; ++k) {
    run.frames.push_back({.tilt = radians(k), .volume_strain = slope * k});
    run.frames.back().thresholds = {{.overloaded_fraction = 0.1 * k}, {.overloaded_fraction = 0.2 * k}};
    run.times.push_back(10.0 + k);
  }
  run.factors = {1.0, 2.0};
  run.theta_c = radians(theta_c);
  run.mean_diameter = 0.5;
  return run;
}

TEST(Ghost, of_one_run_has_its_frames) {
  const Ghost ghost{"one", {run_of(3, 0.01, 2.5)}};
  const GhostCurve curve = ghost_curve(ghost, strain(), PlotAxis::tilt, 1.0);
  ASSERT_EQ(curve.x.size(), 3u);
  EXPECT_NEAR(curve.x[2], 2.0, 1e-12);
  EXPECT_NEAR(curve.mean[2], 2.0, 1e-12) << "in percent";
  EXPECT_TRUE(std::isnan(curve.deviation[2]));
}

TEST(Ghost, of_several_runs_is_their_mean_and_deviation_where_half_of_them_are) {
  const Ghost ghost{
      "five",
      {run_of(3, 0.01, 9), run_of(5, 0.03, 9), run_of(5, 0.05, 9), run_of(8, 0.07, 9), run_of(8, 0.09, 9)}};
  EXPECT_EQ(text_of(ghost), "five: 5 runs, mean ± standard deviation");
  const GhostCurve curve = ghost_curve(ghost, strain(), PlotAxis::tilt, 1.0);
  ASSERT_EQ(curve.x.size(), 8u);
  EXPECT_NEAR(curve.mean[2], 2.0 * 5.0, 1e-9);
  EXPECT_NEAR(curve.deviation[2], 2.0 * std::sqrt(10.0), 1e-9) << "of 1, 3, 5, 7, 9, with n - 1";
  EXPECT_NEAR(curve.mean[4], 4.0 * 6.0, 1e-9) << "one has ended";
  EXPECT_TRUE(std::isnan(curve.mean[5])) << "two of five are less than half";
}

TEST(Ghost, lies_where_each_run_has_that_angle_left) {
  const Ghost ghost{"two", {run_of(5, 0.01, 4.0), run_of(6, 0.01, 5.0)}};
  const GhostCurve curve = ghost_curve(ghost, strain(), PlotAxis::angle_left, 1.0);
  ASSERT_EQ(curve.x.size(), 6u);
  EXPECT_TRUE(std::ranges::is_sorted(curve.x));
  EXPECT_NEAR(curve.x[1], 1.0, 1e-9);
  EXPECT_NEAR(curve.mean[1], 3.5, 1e-9) << "at 3 deg of one and 4 deg of the other";
  Ghost unfailed = ghost;
  for (GhostRun& run : unfailed.runs) run.theta_c = not_known;
  EXPECT_TRUE(ghost_curve(unfailed, strain(), PlotAxis::angle_left, 1.0).x.empty());
}

TEST(Ghost, is_interpolated_between_the_frames_of_a_run) {
  GhostRun coarse = run_of(3, 0.0, 9);
  for (std::size_t k = 0; k < 3; ++k) {
    coarse.frames[k].tilt = radians(2.0 * static_cast<double>(k));
    coarse.frames[k].volume_strain = 0.02 * static_cast<double>(k * k);
  }
  const Ghost ghost{"two", {run_of(5, 0.0, 9), coarse}};
  const GhostCurve curve = ghost_curve(ghost, strain(), PlotAxis::tilt, 1.0);
  ASSERT_EQ(curve.x.size(), 5u);
  EXPECT_NEAR(curve.mean[3], 0.5 * 5.0, 1e-9) << "5 % is midway between 2 and 8 %";
}

TEST(Ghost, is_at_the_threshold_of_the_curves_or_nowhere) {
  const Ghost ghost{"one", {run_of(3, 0.0, 9)}};
  EXPECT_NEAR(ghost_curve(ghost, p_o(), PlotAxis::tilt, 2.0).mean.at(2), 0.4, 1e-12);
  EXPECT_TRUE(ghost_curve(ghost, p_o(), PlotAxis::tilt, 1.5).x.empty());
  EXPECT_FALSE(ghost_curve(ghost, strain(), PlotAxis::tilt, 1.5).x.empty()) << "it has no threshold";
}

TEST(Ghost, is_over_time_where_times_are_known) {
  Ghost ghost{"one", {run_of(3, 0.01, 9)}};
  EXPECT_EQ(ghost_curve(ghost, strain(), PlotAxis::time, 1.0).x.at(1), 11.0);
  ghost.runs[0].times.clear();
  EXPECT_TRUE(ghost_curve(ghost, strain(), PlotAxis::time, 1.0).x.empty());
}

TEST(Ghost, stands_behind_curves_of_quantities_until_it_is_taken_away) {
  const Ghost ghost{"one", {run_of(3, 0.01, 9)}};
  std::vector<Plot> plots = empty_plots();
  plot_ghost(&ghost, PlotAxis::tilt, 1.0, plots);
  const auto plot = [&plots](const char* name) -> const Plot& {
    return *std::ranges::find(plots, name, &Plot::name);
  };
  EXPECT_EQ(plot("strain").series[0].behind.x.size(), 3u);
  EXPECT_EQ(plot("overloaded").series[0].behind.x.size(), 3u);
  EXPECT_TRUE(plot("stress").series[2].behind.x.empty()) << "a law";
  EXPECT_TRUE(plot("iterations").series[0].behind.x.empty());
  plot_ghost(nullptr, PlotAxis::tilt, 1.0, plots);
  EXPECT_TRUE(plot("strain").series[0].behind.x.empty());
}

}  // namespace
}  // namespace talus::view
