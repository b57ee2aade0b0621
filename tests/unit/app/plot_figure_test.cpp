/// Plots of the window as figures: their tables and the parameters of their script.

#include "app/plot_figure.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "app/figure_text.h"

namespace talus::app {
namespace {

view::Plot strain_plot() {
  view::Plot plot = view::plot_of_quantity(analysis::quantity_of(&analysis::FrameRecord::volume_strain));
  plot.series[0].x = {0.0, 1.0};
  plot.series[0].y = {0.0, -0.5};
  plot.series.push_back({"law", {0.0, 1.0}, {0.0, 1.0}, true});
  return plot;
}

std::string variable(const figures::Figure& figure, const std::string& name) {
  const auto found = std::ranges::find(figure.variables, name, &std::pair<std::string, std::string>::first);
  return found == figure.variables.end() ? "" : found->second;
}

TEST(PlotFigure, puts_curves_over_the_same_places_into_one_table_with_units) {
  const figures::Figure figure =
      plot_figure(strain_plot(), {}, {.shown = {}, .theta_c = 19.0}, "runs/a.h5", "");
  EXPECT_EQ(figure.name, "plot-packing-volume_strain");
  ASSERT_EQ(figure.tables.size(), 1u);
  EXPECT_EQ(csv_text(figure.tables[0]), "x,packing/volume_strain,law\n0,0,0\n1,-0.5,1\n");
  EXPECT_EQ(figure.tables[0].columns[0].unit, "deg");
  EXPECT_EQ(figure.tables[0].columns[1].unit, "%");
  EXPECT_EQ(variable(figure, "plotted"), "2");
  EXPECT_EQ(variable(figure, "law_2"), "1");
  EXPECT_EQ(variable(figure, "theta_c_at"), "19");
  EXPECT_EQ(figure.runs, std::vector<std::string>{"runs/a.h5"});
  EXPECT_NE(gnuplot_text(figure).find("behinds"), std::string::npos) << "drawn by plot.gp";
}

TEST(PlotFigure, puts_others_into_others) {
  view::Plot plot = strain_plot();
  plot.series[1].x = {0.0, 2.0};
  plot.series[0].behind = {{0.0, 1.0}, {0.1, 0.2}, {0.01, 0.02}};
  const figures::Figure figure = plot_figure(plot, {}, {}, "", "ten beds");
  ASSERT_EQ(figure.tables.size(), 3u);
  EXPECT_EQ(figures::file_of(figure, figure.tables[1]), "plot-packing-volume_strain-2.csv");
  EXPECT_EQ(figure.tables[2].name, "behind");
  EXPECT_EQ(figure.tables[2].columns[2].values, (std::vector{0.01, 0.02}));
  EXPECT_EQ(variable(figure, "behind_column_1"), "2");
  EXPECT_EQ(variable(figure, "behind_curve_1"), "1");
  EXPECT_NE(figure.caption.find("behind: ten beds"), std::string::npos);
  EXPECT_TRUE(figure.runs.empty());
}

TEST(PlotFigure, is_as_the_plot_is_looked_at) {
  view::Plot plot = strain_plot();
  EXPECT_EQ(variable(plot_figure(plot, {}, {}, "", ""), "x_low"), "");
  EXPECT_EQ(variable(plot_figure(plot, {}, {}, "", ""), "logarithmic"), "0");
  plot.falling_x = true;
  const figures::Figure figure =
      plot_figure(plot, {.zoomed = {{0.25, 0.5}}, .chosen = {}, .log_y = true}, {}, "", "");
  EXPECT_EQ(variable(figure, "x_low"), "0.25");
  EXPECT_EQ(variable(figure, "x_high"), "0.5");
  EXPECT_EQ(variable(figure, "logarithmic"), "1");
  EXPECT_EQ(variable(figure, "falling"), "1");
}

}  // namespace
}  // namespace talus::app
