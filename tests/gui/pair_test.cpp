/// The second view in the window without a display.

#include <gtest/gtest.h>

#include "gui/offscreen_fixture.h"

namespace talus {
namespace {

using test::Live;
using test::Replay;

/// Returns the share of pixels that are neither white nor gray.
double coloured_share(const render::Image& image, const gui::WidgetPlace& place) {
  int coloured = 0, all = 0;
  for (int y = static_cast<int>(place.y0); y < static_cast<int>(place.y1); ++y)
    for (int x = static_cast<int>(place.x0); x < static_cast<int>(place.x1); ++x) {
      const auto* pixel = &image.pixels[3 * static_cast<std::size_t>(y * image.width + x)];
      coloured += pixel[0] != pixel[1] || pixel[1] != pixel[2] ? 1 : 0;
      ++all;
    }
  return static_cast<double>(coloured) / all;
}

TEST_F(Replay, a_key_shows_another_map_beside_and_takes_it_away) {
  EXPECT_FALSE(gui_.has("second map"));
  gui_.key('P');
  ASSERT_TRUE(gui_.has("second map"));
  EXPECT_EQ(model_.state.second_view.layers, (pictures::MapLayers{pictures::MapKind::displacement}));
  const render::Image both = gui_.frame();
  EXPECT_EQ(coloured_share(both, gui_.place("map")), 0.0) << "gray";
  EXPECT_GT(coloured_share(both, gui_.place("second map")), 0.1) << "in a separate texture";
  gui_.key('P');
  EXPECT_FALSE(gui_.has("second map"));
}

TEST_F(Replay, a_key_shows_what_changes_from_here_on) {
  gui_.key(gui::key_right);
  const double here = model_.frame().tilt;
  gui_.key('D');
  ASSERT_TRUE(gui_.has("second map"));
  EXPECT_EQ(model_.state.second_view.minus, std::optional(here));
  gui_.key(gui::key_end);
  EXPECT_NE(model_.second().annotated_map().title.find("1.00° minus 0.25°"), std::string::npos)
      << model_.second().annotated_map().title;
  EXPECT_EQ(model_.second().annotated_map().caption, model_.first().annotated_map().caption);
}

TEST_F(Replay, the_mouse_on_either_view_moves_both) {
  gui_.key('P');
  gui_.scroll("second map", 3.0f);
  EXPECT_GT(model_.state.camera.zoom, 1.5);
  const double before = model_.state.camera.centre_x;
  gui_.drag("second map", 0.5f, 0.5f, 0.4f, 0.5f);
  EXPECT_GT(model_.state.camera.centre_x, before);
  EXPECT_EQ(model_.first().map(2.0).x_min, model_.second().map(2.0).x_min);
}

TEST_F(Replay, a_grain_is_selected_in_either_view) {
  gui_.key('P');
  const gui::WidgetPlace map = gui_.place("map"), second_view = gui_.place("second map");
  EXPECT_EQ(map.x1 - map.x0, second_view.x1 - second_view.x0);
  EXPECT_EQ(map.y1 - map.y0, second_view.y1 - second_view.y0);
  const auto [x, y] = share_of(31);
  gui_.click("second map", x, y);
  EXPECT_EQ(model_.state.selected, std::optional<Index>(31));
}

TEST_F(Replay, the_mouse_tells_values_in_the_second_view) {
  gui_.key('D');
  const auto [x, y] = share_of(31);
  const gui::WidgetPlace at = gui_.place("second map");
  const render::Image before = gui_.frame();
  gui_.move(at.x0 + x * (at.x1 - at.x0), at.y0 + y * (at.y1 - at.y0));
  EXPECT_NE(gui_.frame().pixels, before.pixels);
  EXPECT_EQ(model_.second().bar()->values.size(), static_cast<std::size_t>(model_.statics().free_count));
}

TEST_F(Replay, two_views_have_room_or_it_is_said) {
  gui_.key('P');
  for (const auto& [width, height] : {std::pair(640, 480), {2400, 500}, {900, 1400}, {3000, 2000}}) {
    gui_.resize(width, height);
    ASSERT_TRUE(gui_.has("second map")) << width;
    const gui::WidgetPlace map = gui_.place("map"), second_view = gui_.place("second map");
    EXPECT_TRUE(second_view.x0 >= map.x1 || second_view.y0 >= map.y1) << width << ": one hides the other";
    EXPECT_LE(second_view.x1, static_cast<float>(width));
    EXPECT_LE(second_view.y1, static_cast<float>(height));
  }
  gui_.resize(300, 250);
  EXPECT_FALSE(gui_.has("second map"));
  EXPECT_TRUE(gui_.has("map"));
  EXPECT_NE(model_.state.message.find("no room"), std::string::npos);
  gui_.resize(1400, 900);
  EXPECT_TRUE(gui_.has("second map"));
  EXPECT_EQ(model_.state.message, "");
}

}  // namespace
}  // namespace talus
