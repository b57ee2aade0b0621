/// Plots of the window as JSON.

#include "app/plot_export.h"

#include <gtest/gtest.h>

namespace talus::app {
namespace {

view::Plot strain_plot() {
  view::Plot plot = view::plot_of_quantity(analysis::quantity_of(&analysis::FrameRecord::volume_strain));
  plot.series[0].x = {0.0, 1.0};
  plot.series[0].y = {0.0, -0.5};
  plot.series.push_back({"law", {0.0, 1.0}, {0.0, 1.0}, true});
  plot.series.push_back({"empty", {}, {}});
  return plot;
}

TEST(PlotExport, has_the_curves_with_their_units) {
  const Json json = plot_json(strain_plot(), {}, {.shown = {}, .theta_c = 19.0}, "runs/a.h5");
  EXPECT_EQ(json["name"], "packing/volume_strain");
  ASSERT_EQ(json["series"].size(), 2u) << "those with places on the axis";
  EXPECT_EQ(json["series"][0]["unit"], "%");
  EXPECT_EQ(json["series"][0]["y"], (std::vector{0.0, -0.5}));
  EXPECT_EQ(json["series"][1]["column"], "law");
  EXPECT_EQ(json["series"][1]["law"], true);
  EXPECT_EQ(json["theta_c"], 19.0);
  EXPECT_EQ(json["run"], "runs/a.h5");
  EXPECT_TRUE(json["range"].is_null());
}

TEST(PlotExport, is_as_the_plot_is_looked_at) {
  view::Plot plot = strain_plot();
  EXPECT_EQ(plot_json(plot, {}, {}, "")["logarithmic"], false);
  plot.falling_x = true;
  const Json json = plot_json(plot, {.zoomed = {{0.25, 0.5}}, .chosen = {}, .log_y = true}, {}, "");
  EXPECT_EQ(json["range"], (std::vector{0.25, 0.5}));
  EXPECT_EQ(json["logarithmic"], true);
  EXPECT_EQ(json["falling"], true);
}

}  // namespace
}  // namespace talus::app
