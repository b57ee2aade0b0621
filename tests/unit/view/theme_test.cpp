/// Names of themes, and maps on a dark background.

#include <gtest/gtest.h>

#include "view/scene.h"
#include "view/view_state.h"

namespace talus::view {
namespace {

TEST(Theme, is_called_by_its_name) {
  EXPECT_EQ(theme_of("light"), Theme::light);
  EXPECT_EQ(theme_of("dark"), Theme::dark);
  EXPECT_EQ(theme_of("print"), Theme::print);
}

render::FrameView map_of(std::initializer_list<render::Colour> fills) {
  render::FrameView map;
  for (const render::Colour& fill : fills)
    map.discs.push_back({0.0f, 0.0f, 1.0f, fill, render::gray(0.5), 0.0f});
  return map;
}

TEST(DarkMap, grays_are_mirrored_and_colours_stay) {
  render::FrameView map = map_of({render::white, render::gray(0.5), render::black, {10, 200, 30}});
  map.lines.push_back({0.0f, 0.0f, 1.0f, 0.0f, 0.1f, render::black});
  const render::FrameView dark = on_dark_ground(map);
  EXPECT_TRUE(dark.transparent) << "the background is that of the window";
  EXPECT_LT(render::luma(dark.discs[0].fill), render::luma(dark.discs[1].fill));
  EXPECT_LT(render::luma(dark.discs[1].fill), render::luma(dark.discs[2].fill));
  EXPECT_EQ(dark.discs[3].fill, (render::Colour{10, 200, 30}));
  EXPECT_GT(render::luma(dark.lines[0].colour), 200.0);
  EXPECT_GT(render::luma(dark.discs[0].rim), render::luma(dark.discs[0].fill) + 40.0)
      << "a dark grain is visible by its rim";
}

TEST(DarkMap, the_legend_goes_with_the_grains) {
  render::FrameView map = map_of({render::gray(0.25)});
  map.legends = {{{{"\u03b3", {render::white, render::gray(0.25), render::black}, {}}},
                  {{render::Swatch::Kind::disc, render::gray(0.25), render::black, 0.0, ""}}}};
  const render::FrameView dark = on_dark_ground(map);
  EXPECT_EQ(dark.legends[0].bars[0].colours[1], dark.discs[0].fill);
  EXPECT_EQ(dark.legends[0].swatches[0].fill, dark.discs[0].fill);
}

TEST(DarkMap, a_bar_that_passes_white_keeps_it) {
  render::FrameView map = map_of({render::white, {247, 246, 247}});
  const std::vector<render::Colour> colours = {{5, 48, 97}, {247, 246, 247}, {103, 0, 31}};
  map.legends = {{{{"turn", colours, {}}}, {}}};
  const render::FrameView dark = on_dark_ground(map);
  EXPECT_EQ(dark.discs[0].fill, render::white);
  EXPECT_EQ(dark.legends[0].bars[0].colours, colours);
}

TEST(DarkMap, grains_of_the_floor_are_dark) {
  render::FrameView map = map_of({render::white});
  map.discs[0].hatched = 1.0f;
  const render::FrameView dark = on_dark_ground(map);
  EXPECT_LT(render::luma(dark.discs[0].fill), 70.0);
  EXPECT_GT(render::luma(dark.discs[0].rim), 120.0);
}

}  // namespace
}  // namespace talus::view
