/// The window without a display: widgets are clicked by name, and the effect is checked in the model and in
/// the picture.

#include <gtest/gtest.h>

#include <algorithm>
#include <fmt/core.h>
#include <random>

#include "gui/driven_gui.h"
#include "gui/offscreen_fixture.h"
#include "gui/panels.h"

namespace talus {
namespace {

using test::Live;
using test::Replay;
using test::small_bed;
using test::TemporaryFolder;

/// Returns the share of the pixels in a place that differ.
double difference(const render::Image& a, const render::Image& b, const gui::WidgetPlace& place) {
  int differing = 0, all = 0;
  for (int y = std::max(0, static_cast<int>(place.y0)); y < std::min(a.height, static_cast<int>(place.y1));
       ++y)
    for (int x = std::max(0, static_cast<int>(place.x0)); x < std::min(a.width, static_cast<int>(place.x1));
         ++x) {
      const std::size_t at = 3 * static_cast<std::size_t>(y * a.width + x);
      const bool same = std::equal(a.pixels.begin() + static_cast<std::ptrdiff_t>(at),
                                   a.pixels.begin() + static_cast<std::ptrdiff_t>(at) + 3,
                                   b.pixels.begin() + static_cast<std::ptrdiff_t>(at));
      differing += same ? 0 : 1;
      ++all;
    }
  return all == 0 ? 0.0 : static_cast<double>(differing) / all;
}

TEST_F(Replay, plays_and_pauses) {
  const std::vector<gui::WidgetPlace> before = gui_.places();
  const render::Image still = gui_.frame();
  gui_.click("play");
  EXPECT_TRUE(model_.replay()->playing());
  EXPECT_EQ(test::moved_since(before, gui_), "");
  EXPECT_NE(gui_.frame().pixels, still.pixels) << "the icon is that of a pause";
  gui_.frame(0.6 / model_.replay()->speed());
  EXPECT_EQ(model_.frame_index(), 2u) << "0, 0.25, 0.5 deg: the last at or before 0.6 deg";
  gui_.click("play");
  EXPECT_FALSE(model_.replay()->playing());
  gui_.frame(10.0);
  EXPECT_EQ(model_.frame_index(), 2u);
}

TEST_F(Replay, scrubs_with_the_mouse) {
  const render::Image before = gui_.frame();
  gui_.click("frame", 0.98f);
  EXPECT_EQ(model_.frame_index(), 4u);
  EXPECT_GT(difference(before, gui_.frame(), gui_.place("map")), 0.001);
  gui_.drag("frame", 0.98f, 0.5f, 0.5f, 0.5f);
  EXPECT_EQ(model_.frame_index(), 2u);
}

TEST_F(Replay, moves_by_keys) {
  gui_.key(gui::key_right);
  gui_.key(gui::key_right);
  EXPECT_EQ(model_.frame_index(), 2u);
  gui_.key(gui::key_left);
  EXPECT_EQ(model_.frame_index(), 1u);
  gui_.key(gui::key_end);
  EXPECT_EQ(model_.frame_index(), 4u);
  gui_.key(gui::key_home);
  EXPECT_EQ(model_.frame_index(), 0u);
}

TEST_F(Replay, overlays_by_keys_are_each_map_but_the_one_below) {
  const pictures::MapLayers& layers = model_.state.map.layers;
  model_.state.map.layers = {pictures::map_kinds()[1]};
  std::vector<pictures::MapKind> seen;
  for (gui_.key('o'); layers.size() > 1; gui_.key('o')) seen.push_back(layers[1]);
  std::vector<pictures::MapKind> others(pictures::map_kinds().begin(), pictures::map_kinds().end());
  std::erase(others, layers[0]);
  EXPECT_EQ(seen, others);
}

TEST_F(Replay, a_map_is_chosen_in_the_list) {
  const render::Image before = gui_.frame();
  gui_.key('M');
  gui_.click("map kind");
  gui_.click("map kind: pressure");
  ASSERT_EQ(model_.state.map.layers, (pictures::MapLayers{pictures::MapKind::pressure}));
  EXPECT_GT(difference(before, gui_.frame(), gui_.place("map")), 0.1);
  gui_.key('1');
  EXPECT_EQ(model_.state.map.layers, (pictures::MapLayers{pictures::MapKind::gamma}));
}

TEST_F(Replay, escape_closes_a_list_before_it_selects_no_grain) {
  model_.state.selected = 7;
  gui_.settle();  // unfolds the inspector
  gui_.key('M');
  gui_.click("map kind");
  ASSERT_TRUE(gui_.has("map kind: pressure"));
  gui_.key(gui::key_escape);
  EXPECT_FALSE(gui_.has("map kind: pressure"));
  EXPECT_EQ(model_.state.selected, std::optional<Index>(7));
  gui_.key(gui::key_escape);
  EXPECT_FALSE(model_.state.selected);
}

TEST_F(Replay, escape_closes_whatever_is_open_and_leaves_the_selection) {
  model_.state.selected = 7;
  for (const auto& [opens, inside] :
       {std::pair{"export plots", "plots folder"}, {"add plot", "quantity filter"}}) {
    gui_.click(opens);
    ASSERT_TRUE(gui_.has(inside)) << opens;
    gui_.key(gui::key_escape);
    EXPECT_FALSE(gui_.has(inside)) << opens;
    EXPECT_EQ(model_.state.selected, std::optional<Index>(7)) << opens;
  }
}

TEST_F(Replay, motion_since_an_angle_is_drawn_before_it_too) {
  model_.state.map.layers = {pictures::MapKind::displacement};
  model_.state.map.range_low = 1e-9;  // the bed is small and creeps
  model_.state.map.range_high = 1e-2;
  gui_.key(gui::key_right);
  gui_.key(gui::key_right);
  const render::Image per_degree = gui_.frame();
  gui_.key(gui::key_end);
  gui_.key('v');
  EXPECT_EQ(model_.state.since, std::optional(model_.frame().tilt));
  EXPECT_NE(model_.first().annotated_map().title.find("per degree"), std::string::npos)
      << "nothing has moved since then";
  gui_.key(gui::key_home);
  gui_.key(gui::key_right);
  gui_.key(gui::key_right);
  EXPECT_EQ(model_.first().annotated_map().title.find("since"), std::string::npos)
      << model_.first().annotated_map().title;
  EXPECT_EQ(difference(per_degree, gui_.frame(), gui_.place("map")), 0.0);
  EXPECT_EQ(model_.render_command().find("--since"), std::string::npos);
  gui_.key('v');
  EXPECT_FALSE(model_.state.since) << "per degree again";
  gui_.key('v');
  gui_.key(gui::key_right);
  EXPECT_NE(model_.first().annotated_map().title.find("since 0.50°"), std::string::npos)
      << model_.first().annotated_map().title;
}

TEST_F(Replay, a_grain_is_selected_where_it_is_clicked) {
  for (const Index grain : {Index{7}, Index{31}}) {
    const auto [x, y] = share_of(grain);
    gui_.click("map", x, y);
    ASSERT_TRUE(model_.state.selected.has_value());
    EXPECT_EQ(*model_.state.selected, grain);
  }
  gui_.key(gui::key_escape);
  EXPECT_FALSE(model_.state.selected.has_value());
}

TEST_F(Replay, the_first_click_moves_nothing) {
  const std::vector<gui::WidgetPlace> before = gui_.places();
  const auto [x, y] = share_of(7);
  gui_.click("map", x, y);
  ASSERT_EQ(model_.state.selected, std::optional<Index>(7));
  expect_unmoved(before);
  gui_.click("map", x, y);
  EXPECT_EQ(model_.state.selected, std::optional<Index>(7)) << "the same place shows the same grain";
}

TEST_F(Replay, the_wheel_zooms_about_the_mouse) {
  const auto [x, y] = share_of(12);
  gui_.scroll("map", 4.0f, x, y);
  EXPECT_GT(model_.state.camera.zoom, 2.0);
  gui_.click("map", x, y);
  EXPECT_EQ(model_.state.selected, 12) << "the point under the mouse stays";
  gui_.key('f');
  EXPECT_EQ(model_.state.camera.zoom, 1.0);
}

TEST_F(Replay, a_drag_moves_the_picture_and_selects_nothing) {
  gui_.scroll("map", 4.0f);
  const double before = model_.state.camera.centre_x;
  gui_.drag("map", 0.5f, 0.5f, 0.3f, 0.5f);
  EXPECT_GT(model_.state.camera.centre_x, before) << "the bed follows the mouse to the left";
  EXPECT_FALSE(model_.state.selected.has_value());
}

TEST_F(Replay, a_question_mark_lists_the_keys) {
  const render::Image before = gui_.frame();
  EXPECT_FALSE(gui_.has("help"));
  gui_.key('?');
  EXPECT_TRUE(model_.state.show_help);
  EXPECT_GT(difference(before, gui_.frame(), gui_.place("help")), 0.05);
  gui_.key(gui::key_escape);
  EXPECT_FALSE(gui_.has("help"));
  EXPECT_EQ(gui_.frame().pixels, before.pixels) << "everything is unchanged";
}

/// Counts the pixels of the map that differ from the same view drawn alone, to the right of and below the
/// arrow of gravity.
int differing_from_render(const render::Image& window, const gui::WidgetPlace& map,
                          const render::Image& alone) {
  int differing = 0;
  for (int y = 60; y < alone.height - 1; ++y)
    for (int x = 60; x < alone.width; ++x) {
      const int column = x + static_cast<int>(map.x0), row = y + static_cast<int>(map.y0);
      const std::uint8_t* shown = window.pixels.data() + 3 * (row * window.width + column);
      const std::uint8_t* drawn = alone.pixels.data() + alone.channels * (y * alone.width + x);
      for (int channel = 0; channel < 3; ++channel)
        if (shown[channel] != drawn[alone.channels == 1 ? 0 : channel]) {
          ++differing;
          break;
        }
    }
  return differing;
}

TEST_F(Replay, the_map_is_the_one_of_talus_render) {
  const gui::WidgetPlace map = gui_.place("map");
  const double aspect = static_cast<double>(map.x1 - map.x0) / static_cast<double>(map.y1 - map.y0);
  for (const char key : {'1', '3'}) {  // gamma in gray, and clusters in colour
    gui_.key(key);
    const render::Image window = gui_.frame();
    const render::Image alone =
        gui_.draw_image(model_.first().map(aspect), static_cast<int>(map.x1 - map.x0));
    ASSERT_GT(alone.width * alone.height, 100000);
    EXPECT_LT(differing_from_render(window, map, alone), alone.width * alone.height / 1000);
  }
}

TEST_F(Replay, a_name_is_typed_and_a_picture_asked_for) {
  gui_.key('F');
  gui_.click("picture path");
  gui_.key('a', true);
  gui_.type("bed_at_rest.png");
  gui_.click("save picture");
  EXPECT_EQ(gui_.requests().save_png_path, "bed_at_rest.png");
  EXPECT_EQ(model_.frame_index(), 0u) << "text typed into a field is not a key";
}

TEST_F(Replay, titles_of_plots_have_room) {
  for (const float scale : {1.0f, 1.5f, 2.0f}) {
    const test::DrivenGui gui(model_, 2400, 1600, scale);
    const gui::WidgetPlace plot = gui.place("plot overloaded"), button = gui.place("play");
    const float em = (button.y1 - button.y0) / 1.53f;  // a button is as high as a line with its frame
    EXPECT_GT(plot.x1 - plot.x0, 16.5f * em) << scale;
  }
}

TEST_F(Replay, a_small_window_has_what_is_needed) {
  gui_.resize(640, 400);
  gui_.click("frame", 0.98f);
  EXPECT_EQ(model_.frame_index(), 4u);
  gui_.key('?');
  const gui::WidgetPlace help = gui_.place("help");
  EXPECT_GE(help.x0, 0.0f);
  EXPECT_GE(help.y0, 0.0f);
  EXPECT_LE(help.x1, 640.0f);
  EXPECT_LE(help.y1, 400.0f);
}

TEST_F(Replay, the_bar_goes_where_it_is_told_to) {
  gui_.key('M');
  const render::Image before = gui_.frame();
  gui_.click("range");
  ASSERT_TRUE(model_.state.map.range_high.has_value());
  gui_.move(700.0f, 895.0f);  // where hints hide no part of the map
  EXPECT_EQ(difference(before, gui_.frame(), gui_.place("map")), 0.0) << "it begins with the current range";
  gui_.click("range high");
  gui_.key('a', true);
  gui_.type("0.3");
  gui_.click("map", 0.5f, -0.02f);
  EXPECT_DOUBLE_EQ(*model_.state.map.range_high, 0.3);
  EXPECT_GT(difference(before, gui_.frame(), gui_.place("map")), 0.01);
  EXPECT_NE(model_.render_command().find("--range"), std::string::npos);
  gui_.key('2');
  EXPECT_FALSE(gui_.has("range")) << "overloaded grains have no bar";
}

TEST_F(Replay, the_border_of_the_plots_is_moved) {
  const float before = gui_.place("border").y0;
  gui_.drag("border", 0.5f, 0.5f, 0.5f, -20.0f);
  EXPECT_LT(gui_.place("border").y0, before - 50.0f);
  EXPECT_GT(gui_.place("border").y0, 0.3f * before);
  EXPECT_LE(gui_.place("map").y1, gui_.place("border").y0);
}

TEST_F(Replay, places_that_a_run_does_not_have_cannot_be_gone_to) {
  EXPECT_FALSE(model_.place_of(view::Landmark::theta_c)) << "nothing fails at 1 deg";
  gui_.click("last");
  gui_.key('c');
  EXPECT_EQ(model_.frame_index() + 1, model_.frame_count());
}

TEST_F(Replay, ends_on_request) {
  EXPECT_FALSE(gui_.requests().quit);
  gui_.key('q');
  EXPECT_TRUE(gui_.requests().quit);
}

TEST(Scale, two_doubles_text_and_widgets) {
  TemporaryFolder folder;
  test::write_file(folder, "bed.toml", small_bed);
  view::ViewModel model = view::ViewModel::open(folder.path("bed.toml"), {}, "", false, "");
  float height = 0.0f;
  {
    const test::DrivenGui plain(model, 1400, 900);
    const gui::WidgetPlace play = plain.place("play");
    height = play.y1 - play.y0;
  }
  test::DrivenGui large(model, 1400, 900, 2.0f);
  const gui::WidgetPlace play = large.place("play");
  EXPECT_NEAR(play.y1 - play.y0, 2.0f * height, 2.0f);
  EXPECT_LE(large.place("map").x1, 1400.0f);
}

TEST_F(Live, steps_are_counted) {
  EXPECT_EQ(status().step, 0);
  gui_.click("step 1");
  EXPECT_TRUE(wait_until([&] { return status().step == 1 && !status().running; }));
  gui_.click("step 10");
  EXPECT_TRUE(wait_until([&] { return status().step == 11 && !status().running; }));
  EXPECT_TRUE(wait_until([&] { return model_.frame().step == 11; })) << "the picture follows";
}

TEST_F(Live, plays_pauses_and_begins_anew) {
  const render::Image before = gui_.frame();
  gui_.click("play");
  EXPECT_TRUE(wait_until([&] { return model_.frame().step > 50; }));
  EXPECT_GT(difference(before, gui_.frame(), gui_.place("map")), 0.005);
  gui_.click("play");
  EXPECT_TRUE(wait_until([&] { return !status().running; }));
  const std::int64_t step = status().step;
  EXPECT_FALSE(wait_until([&, k = 0]() mutable { return status().step != step || ++k > 10; }) &&
               status().step != step);
  gui_.click("reset");
  EXPECT_EQ(status().step, step) << "it is unsaved, so the user is asked first";
  gui_.click("reset");
  EXPECT_TRUE(wait_until([&] { return status().step == 0 && model_.recording().seed == 18; }));
}

TEST_F(Live, begins_anew_with_a_seed_that_is_typed) {
  gui_.click("seed");
  gui_.key('a', true);
  gui_.type("9007199254740993");
  gui_.click("reset");
  EXPECT_EQ(model_.recording().seed, 9007199254740993u);
}

TEST_F(Live, is_saved_by_a_key_and_goes_on_there) {
  gui_.click("step 10");
  ASSERT_TRUE(wait_until([&] { return status().step == 10 && !status().running; }));
  model_.state.run_path = folder_.path("late.h5");
  gui_.key('s');
  EXPECT_EQ(model_.recording().output, folder_.path("late.h5"));
  EXPECT_NE(model_.state.message.find("Saved at step 10"), std::string::npos) << model_.state.message;
  EXPECT_TRUE(std::filesystem::exists(folder_.path("late.h5.run")));
  gui_.key('F');
  EXPECT_FALSE(gui_.has("run path")) << "it is recorded from here on";
  EXPECT_TRUE(gui_.has("save state"));
}

TEST_F(Live, has_a_pace) {
  gui_.key('>');
  EXPECT_EQ(model_.state.pace, 1);
  EXPECT_NE(model_.state.message.find("real time"), std::string::npos) << model_.state.message;
  gui_.key('<');
  gui_.key('<');
  EXPECT_EQ(model_.state.pace, 0);
  gui_.place("pace");
}

TEST_F(Live, friction_and_pushes_are_commands) {
  gui_.click("deposit");
  ASSERT_TRUE(wait_until([&] { return !status().depositing && !status().running; }));
  gui_.key('n');
  gui_.key('A');
  gui_.click("push");
  gui_.click("friction", 0.5f);
  const std::vector<Command> commands = model_.live()->commands();
  ASSERT_EQ(commands.size(), 2u) << "one for each";
  EXPECT_EQ(commands[0].kind, CommandKind::push);
  EXPECT_EQ(commands[0].grain, 0);
  EXPECT_EQ(commands[0].step, status().step);
  EXPECT_EQ(commands.back().kind, CommandKind::friction);
  EXPECT_NEAR(commands.back().x, status().friction, 1e-12);
  EXPECT_NE(commands.back().x, 0.5) << "the previous one";
  EXPECT_TRUE(
      model_.state.message.starts_with(fmt::format("Applied after step {}: friction ", commands[1].step)))
      << model_.state.message;
  gui_.drag("tilt rate", 0.3f, 0.5f, 0.7f, 0.5f);
  ASSERT_EQ(model_.live()->commands().size(), 3u) << "only when released";
  EXPECT_EQ(model_.live()->commands()[2].kind, CommandKind::tilt_rate);
  EXPECT_NEAR(model_.live()->commands()[2].x, 4.0, 1.0) << "of -10 to 10 deg/s";
  EXPECT_DOUBLE_EQ(status().tilt_rate, model_.live()->commands()[2].x);
  gui_.click("drop");
  ASSERT_EQ(model_.live()->commands().size(), 4u);
  EXPECT_EQ(model_.live()->commands()[3].kind, CommandKind::drop);
  EXPECT_EQ(model_.live()->commands()[3].grain, 5) << "grains";
}

/// Presses keys and clicks at random places, from a fixed seed, except those that would leave the window or
/// write files.
void use_at_random(test::DrivenGui& gui, view::ViewModel& model, int events) {
  std::mt19937_64 random(7);
  const auto below = [&random](std::uint64_t count) { return random() % count; };
  const std::string keys = " djpc<>1234567890omv[],.;'tf+-waxzniygbrukRMASFGTLhl?";
  for (int k = 0; k < events; ++k) {
    const std::vector<gui::WidgetPlace> places = gui.places();
    const std::string name = places.empty() ? "" : places[below(places.size())].name;
    const float x = 0.01f * static_cast<float>(below(100)), y = 0.01f * static_cast<float>(below(100));
    const bool writes = name.starts_with("file ") || name.starts_with("save") || name == "write table";
    if (below(2) == 0 || writes || name.empty()) {
      gui.key(static_cast<unsigned char>(keys[below(keys.size())]));
    } else if (below(4) == 0) {
      gui.drag(name, x, y, y, x);
    } else if (below(4) == 0) {
      gui.scroll(name, below(2) == 0 ? 2.0f : -2.0f, x, y);
    } else {
      gui.click(name, x, y);
    }
    if (k % 16 == 0) gui.resize(300 + static_cast<int>(below(1200)), 250 + static_cast<int>(below(700)));
    (void)gui.frame(0.1);
    ASSERT_GT(model.frame().grain_count(), 0) << "after " << k << " events";
  }
}

TEST_F(Replay, survives_use_at_random) {
  use_at_random(gui_, model_, 60);
  EXPECT_LT(model_.frame_index(), model_.frame_count());
}

TEST_F(Live, survives_use_at_random) {
  use_at_random(gui_, model_, 60);
  model_.live()->halt();
  EXPECT_FALSE(status().running);
}

}  // namespace
}  // namespace talus
