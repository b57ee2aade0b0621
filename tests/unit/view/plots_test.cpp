/// Curves next to the map, from hand-made rows.

#include "view/plots.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/trigonometry.h"
#include "unit/view/example_bed.h"

namespace talus::view {
namespace {

const Plot& plot(const std::vector<Plot>& plots, const std::string& name) {
  return *std::ranges::find(plots, name, &Plot::name);
}

std::vector<Plot> plots_of_row(const ObservableRow& row) {
  std::vector<Plot> plots = empty_plots();
  plot_observables(std::vector{row}, example::bed_statics(), {}, plots);
  return plots;
}

TEST(Plots, are_told_apart_by_name) {
  std::set<std::string> names;
  for (const Plot& each : empty_plots()) {
    names.insert(each.name);
    EXPECT_FALSE(each.series.empty());
    EXPECT_FALSE(each.series[0].law);
  }
  EXPECT_EQ(names.size(), empty_plots().size());
}

TEST(Plots, of_stress_have_the_laws_beside_them) {
  ObservableRow row{};
  at(row, Observable::tilt) = radians(30.0);
  at(row, Observable::stress_ratio) = 0.4;
  at(row, Observable::sigma_t_over_n) = 0.7;
  const auto plots = plots_of_row(row);
  const Plot& stress = plot(plots, "stress");
  ASSERT_EQ(stress.series.size(), 4u);
  const double expected[] = {0.4, 0.7, 0.5, 1.0 / std::sqrt(3.0)};
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(stress.series[k].x.at(0), 30.0, 1e-12);
    EXPECT_NEAR(stress.series[k].y.at(0), expected[k], 1e-12);
    EXPECT_EQ(stress.series[k].law, k >= 2);
  }
}

TEST(Plots, give_strain_in_percent_and_energy_by_the_weight_of_a_grain) {
  ObservableRow row{};
  at(row, Observable::volume_strain) = -0.02;
  at(row, Observable::kinetic_energy) = 4.0;
  RunStatics statics = example::bed_statics();
  statics.mean_diameter = 0.5;
  std::vector<Plot> plots = empty_plots();
  plot_observables(std::vector{row}, statics, {}, plots);
  EXPECT_NEAR(plot(plots, "strain").series[0].y.at(0), -2.0, 1e-12);
  EXPECT_NEAR(plot(plots, "energy").series[0].y.at(0), 4.0 / (40 * 2.0 * 10.0 * 0.5), 1e-15);
  EXPECT_TRUE(plot(plots, "energy").log_y);
}

TEST(Plots, leave_out_what_a_logarithm_cannot_show) {
  EXPECT_TRUE(std::isnan(plot(plots_of_row({}), "energy").series[0].y.at(0)));
}

TEST(Plots, of_frames_are_over_degrees) {
  std::vector<Plot> plots = empty_plots();
  const analysis::FrameRecord frame{
      .tilt = radians(10.0),
      .thresholds = {{.overloaded_fraction = 0.25, .lc_mean = 1.5, .lc_max = 3.5, .largest_share = 0.5}}};
  plot_frames(std::vector{frame, frame}, std::vector{1.0, 2.0}, 0.5, {}, plots);
  plot_frames(std::vector{frame}, std::vector{1.0}, 0.5, {}, plots);  // replaces the previous ones
  ASSERT_EQ(plot(plots, "overloaded").series[0].x.size(), 1u);
  EXPECT_NEAR(plot(plots, "overloaded").series[0].x[0], 10.0, 1e-12);
  EXPECT_EQ(plot(plots, "overloaded").series[0].y[0], 0.25);
  EXPECT_EQ(plot(plots, "cluster").series[0].y[0], 0.5);
  EXPECT_EQ(plot(plots, "lengths").series[0].y[0], 3.0);
  EXPECT_EQ(plot(plots, "lengths").series[1].y[0], 7.0);
}

TEST(Plots, have_the_same_angle_left_on_either_side) {
  EXPECT_NEAR(place_on({PlotAxis::angle_left, radians(20.0)}, radians(-18.0), 0.0), 2.0, 1e-12);
  EXPECT_NEAR(place_on({PlotAxis::tilt, radians(20.0)}, radians(-18.0), 0.0), -18.0, 1e-12);
}

TEST(Plots, are_over_the_tilt_the_angle_left_or_time) {
  analysis::FrameRecord frame{.tilt = radians(18.0), .thresholds = {{}}};
  ObservableRow row{};
  at(row, Observable::tilt) = radians(15.0);
  at(row, Observable::time) = 2.5;
  for (const auto& [axis, title, of_frame, plots_of_row] : {std::tuple{PlotAxis::tilt, "θ (°)", 18.0, 15.0},
                                                            {PlotAxis::angle_left, "θ_c − θ (°)", 2.0, 5.0},
                                                            {PlotAxis::time, "t (s)", 3.5, 2.5}}) {
    std::vector<Plot> plots = empty_plots();
    name_axis(axis, plots);
    const PlotAbscissa abscissa{axis, radians(20.0)};
    plot_frames(std::vector{frame}, std::vector{3.5, 4.5}, 0.5, abscissa, plots);
    plot_observables(std::vector{row}, example::bed_statics(), abscissa, plots);
    EXPECT_EQ(plot(plots, "cluster").x_title, title);
    EXPECT_EQ(plot(plots, "cluster").falling_x, axis == PlotAxis::angle_left);
    EXPECT_EQ(plot(plots, "gamma").x_title, "γ = q/p");
    EXPECT_NEAR(plot(plots, "cluster").series[0].x.at(0), of_frame, 1e-12) << title;
    for (const PlotSeries& series : plot(plots, "stress").series)
      EXPECT_NEAR(series.x.at(0), plots_of_row, 1e-12) << title;
    EXPECT_NEAR(plot(plots, "energy").series[0].x.at(0), plots_of_row, 1e-12) << title;
  }
}

TEST(Plots, of_a_stored_analysis_leave_what_has_a_threshold) {
  std::vector<Plot> plots = {plot_of_quantity(analysis::quantity_of(&analysis::FrameRecord::gamma_mean)),
                             plot_of_quantity(analysis::quantity_of(&analysis::FrameThreshold::lc_mean))};
  plot_frames(std::vector{analysis::FrameRecord{.tilt = radians(10.0), .gamma_mean = 0.25}}, std::vector{1.0},
              0.5, {}, plots, true);
  EXPECT_EQ(plots[0].name, "gamma/mean");
  EXPECT_EQ(plots[0].series[0].y, std::vector{0.25});
  EXPECT_TRUE(plots[1].series[0].x.empty());
  EXPECT_EQ(plots[1].title, "Mean ℓ_c of the overloaded grains (D)");
}

TEST(Plots, are_of_any_quantity) {
  const analysis::Quantity made_up = {
      &analysis::FrameRecord::critical_largest, "made_up", "T", "1", "made up", "", {"M", "Made up"}};
  std::vector<Plot> plots = {plot_along_run("made_up", analysis::shown_title(made_up), {series_of(made_up)})};
  plot_frames(std::vector{analysis::FrameRecord{.tilt = radians(10.0), .critical_largest = 7}},
              std::vector{0.0}, 0.5, {}, plots);
  EXPECT_EQ(plots[0].title, "Made up");
  EXPECT_EQ(plots[0].series[0].name, "M");
  EXPECT_EQ(plots[0].series[0].y, std::vector{7.0});
}

TEST(Plots, say_the_threshold_that_they_are_of) {
  std::vector<Plot> plots = empty_plots();
  note_threshold(0.9, std::nullopt, plots);
  EXPECT_EQ(plot(plots, "overloaded").note, "at 0.9 Γ_c");
  EXPECT_EQ(plot(plots, "lengths").note, "at 0.9 Γ_c");
  EXPECT_EQ(plot(plots, "strain").note, "");
  note_threshold(1.0, radians(20.0), plots);
  EXPECT_EQ(plot(plots, "cluster").note, "at 1 Γ_c, if θ_c = 20°");
}

TEST(Plots, have_statistics_of_a_range) {
  const PlotSeries series{"", {0.0, 1.0, 2.0, 3.0, 4.0}, {9.0, 2.0, not_known, 6.0, 9.0}, false, {}};
  const RangeStatistics statistics = statistics_of(series, 1.0, 3.0);
  EXPECT_EQ(statistics.count, 2);
  EXPECT_DOUBLE_EQ(statistics.mean, 4.0);
  EXPECT_DOUBLE_EQ(statistics.deviation, std::sqrt(8.0));
  EXPECT_DOUBLE_EQ(statistics.slope, 2.0);
  EXPECT_TRUE(std::isnan(statistics_of(series, 5.0, 6.0).mean));
  EXPECT_TRUE(std::isnan(statistics_of(series, 0.5, 1.5).deviation));
  EXPECT_TRUE(std::isnan(statistics_of(series, 0.5, 1.5).slope));
}

TEST(Plots, of_gamma_are_a_density_of_the_frame) {
  std::vector<Plot> plots = empty_plots();
  plot_gamma({example::bed_frame(0.0, 4), example::bed_statics()}, plots);
  const Plot& gamma = plot(plots, "gamma");
  const PlotSeries& density = gamma.series[0];
  EXPECT_FALSE(gamma.along_run);
  const double width = density.x[1] - density.x[0];
  EXPECT_NEAR(density.y.front() * width, 0.9, 1e-12);  // 36 grains at 0, 4 at 1
  EXPECT_NEAR(density.y.back() * width, 0.1, 1e-12);
}

}  // namespace
}  // namespace talus::view
