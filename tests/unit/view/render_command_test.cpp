/// Command line that draws the picture shown.

#include <gtest/gtest.h>

#include "core/trigonometry.h"
#include "view/scene.h"

namespace talus::view {
namespace {

RenderRequest shown(const char* map) {
  RenderRequest request;
  request.run = "runs/a.h5";
  request.settings.layers = pictures::map_layers(map);
  request.settings.theta_c = radians(20.0);
  request.tilt = radians(12.25);
  return request;
}

/// Returns a request with every setting that some map depends on.
RenderRequest shown_with_all(const char* map) {
  RenderRequest request = shown(map);
  request.settings.theta_c_assumed = true;
  request.settings.threshold_factor = 2.0;
  request.settings.l_min = 4.5;
  request.settings.length = 7.5;
  request.settings.joined_by_neighbours = true;
  request.settings.colours = render::ColourMap::viridis;
  request.settings.range_low = 0.1;
  request.settings.range_high = 0.6;
  return request;
}

TEST(RenderCommand, of_defaults_says_the_map_and_the_angle) {
  EXPECT_EQ(render_command_line(shown("gamma")), "talus render runs/a.h5 --map gamma --at 12.25");
}

TEST(RenderCommand, has_each_setting_that_the_map_depends_on) {
  RenderRequest request = shown_with_all("coarse+clusters");
  request.settings.turned = true;
  request.settings.palette = pictures::ClusterPalette::contrast;
  EXPECT_EQ(
      render_command_line(request),
      "talus render runs/a.h5 --map coarse+clusters --at 12.25 --set gamma_c=0.34202014 --set l_min=4.5 "
      "--set threshold_factors=2 "
      "--set length=7.5 "
      "--set joining=neighbours --colours viridis,contrast --range 0.1,0.6 --turned");
}

/// `talus render` rejects options that have no effect.
TEST(RenderCommand, leaves_out_what_the_map_does_not_depend_on) {
  RenderRequest request = shown_with_all("forces");
  request.since = radians(5.0);
  EXPECT_EQ(render_command_line(request), "talus render runs/a.h5 --map forces --at 12.25");
}

TEST(RenderCommand, of_gamma_has_no_threshold) {
  RenderRequest request = shown("gamma");
  request.settings.threshold_factor = 2.0;
  EXPECT_EQ(render_command_line(request), "talus render runs/a.h5 --map gamma --at 12.25");
}

TEST(RenderCommand, measures_displacements_since_an_angle) {
  RenderRequest request = shown("displacement");
  request.since = radians(5.0);
  EXPECT_EQ(render_command_line(request),
            "talus render runs/a.h5 --map displacement --at 12.25 --since 5 --range 0.001,10");
}

TEST(RenderCommand, has_the_fixed_range_of_motion) {
  RenderRequest request = shown("displacement");
  EXPECT_TRUE(render_command_line(request).ends_with("--at 12.25 --range 0.0001,10"));
  request.in_flow = true;
  EXPECT_TRUE(render_command_line(request).ends_with("--flow --range 0.001,10"));
  EXPECT_TRUE(render_command_line(shown("forces+rotation")).ends_with("--range -10,10"));
  EXPECT_EQ(render_command_line(shown("gamma+displacement")).find("--range"), std::string::npos)
      << "arrows have no bar";
}

TEST(RenderCommand, asks_for_the_flow) {
  RenderRequest request = shown("pressure");
  request.in_flow = true;
  EXPECT_EQ(render_command_line(request), "talus render runs/a.h5 --map pressure --at 12.25 --flow");
}

TEST(RenderCommand, crops_in_diameters_and_never_beyond_the_part) {
  RenderRequest request = shown("gamma");
  request.mean_diameter = 0.01;
  request.part = pictures::MapExtent{0.10001, 0.20009, -0.00501, 0.40009};
  EXPECT_EQ(render_command_line(request),
            "talus render runs/a.h5 --map gamma --at 12.25 --crop 10.01,-0.5,20,40");
}

TEST(RenderCommand, quotes_for_the_shell) {
  RenderRequest request = shown("gamma");
  request.run = "my run.h5";
  EXPECT_EQ(render_command_line(request), "talus render 'my run.h5' --map gamma --at 12.25");
}

}  // namespace
}  // namespace talus::view
