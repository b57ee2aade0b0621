/// The column: groups that fold and unfold, labels in front of their widgets, and rows that keep their
/// places.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "gui/offscreen_fixture.h"

namespace talus {
namespace {

using test::Live;
using test::Replay;

/// Expects that a widget is visible and usable inside the column.
void expect_in_sight(const test::DrivenGui& gui, const std::string& name, float height) {
  ASSERT_TRUE(gui.has(name)) << name;
  const gui::WidgetPlace place = gui.place(name);
  EXPECT_GE(place.y0, 0.0f) << name;
  EXPECT_LE(place.y1, height) << name;
}

TEST_F(Replay, a_heading_folds_and_unfolds) {
  EXPECT_FALSE(gui_.has("push")) << "folded initially";
  gui_.click("group map");
  EXPECT_FALSE(gui_.has("map kind"));
  gui_.click("group map");
  EXPECT_TRUE(gui_.has("map kind"));
  gui_.key('F');
  gui_.click("group files");
  EXPECT_FALSE(gui_.has("save picture"));
  gui_.click("group act");
  expect_in_sight(gui_, "group act", 900.0f);
  expect_in_sight(gui_, "branch here", 900.0f);
  EXPECT_TRUE(gui_.has("map kind")) << "other groups stay unfolded if there is room";
}

TEST_F(Replay, a_low_column_has_one_group_and_brings_it_into_sight) {
  test::DrivenGui low(model_, 640, 480);
  const std::map<char, const char*> widgets = {
      {'M', "map kind"}, {'A', "branch here"}, {'F', "save picture"}, {'R', "frame"}};
  EXPECT_FALSE(low.has("map kind"));
  for (const auto& [key, widget] : widgets) {
    low.key(key);
    expect_in_sight(low, widget, 480.0f);
    for (const auto& [other, folded] : widgets)
      if (other != key) {
        EXPECT_FALSE(low.has(folded)) << key << other;
      }
  }
}

TEST_F(Replay, the_map_has_at_least_half_of_the_window) {
  gui_.resize(1280, 800);
  for (const char* map : {"gamma", "displacement", "clusters+forces"}) {
    model_.state.map.layers = pictures::map_layers(map);
    gui_.settle();
    const gui::WidgetPlace border = gui_.place("border");  // below the map, and as wide
    EXPECT_GE((border.x1 - border.x0) * border.y0, 0.5f * 1280.0f * 800.0f) << map;
  }
}

TEST_F(Replay, labels_are_on_the_left_and_widgets_below_each_other) {
  const gui::WidgetPlace first = gui_.place("map kind"), column = gui_.place("group map");
  EXPECT_GT(first.x0, column.x0 + 0.3f * (column.x1 - column.x0));
  for (const char* name : {"overlay", "colours", "l_min", "threshold", "length", "speed"}) {
    EXPECT_EQ(gui_.place(name).x0, first.x0) << name;
    EXPECT_EQ(gui_.place(name).x1, first.x1) << name << " fills the rest of its row";
  }
}

TEST_F(Live, nothing_moves_while_the_run_goes_on) {
  model_.state.selected = 20;
  gui_.settle();
  gui_.key('R');
  const std::vector<gui::WidgetPlace> before = gui_.places();
  gui_.click("deposit");
  EXPECT_TRUE(wait_until([&] { return status().step > 20; }));
  EXPECT_EQ(test::moved_since(before, gui_), "") << "in the deposition";
  EXPECT_TRUE(wait_until([&] { return !status().depositing && !status().running; }));
  gui_.settle();  // the last drawing may be one step behind
  EXPECT_FALSE(gui_.has("deposit"));
  EXPECT_EQ(test::moved_since(before, gui_), "") << "at rest";
  gui_.click("play");
  EXPECT_TRUE(wait_until([&] { return status().done; }));
  gui_.settle();
  EXPECT_EQ(test::moved_since(before, gui_), "") << "at the end";
}

Index contacts_of(const Frame& frame, Index grain) {
  return static_cast<Index>(std::ranges::count(frame.contacts.a, grain) +
                            std::ranges::count(frame.contacts.b, grain));
}

/// Returns the grain whose number of contacts varies most between frames.
Index busiest_grain(view::ViewModel& model) {
  Index busiest = 0, largest = -1;
  for (Index grain = 0; grain < model.statics().free_count; ++grain) {
    Index low = 100, high = 0;
    for (std::size_t frame = 0; frame < model.frame_count(); ++frame) {
      model.go_to(frame);
      low = std::min(low, contacts_of(model.frame(), grain));
      high = std::max(high, contacts_of(model.frame(), grain));
    }
    if (high - low <= largest) continue;
    busiest = grain;
    largest = high - low;
  }
  EXPECT_GT(largest, 0) << "all grains of this run have a constant number of contacts";
  return busiest;
}

TEST_F(Replay, the_first_selection_unfolds_the_inspector) {
  EXPECT_FALSE(gui_.has("outline"));
  gui_.key('n');
  expect_in_sight(gui_, "outline", 900.0f);
  gui_.click("group grain");
  EXPECT_FALSE(gui_.has("outline"));
  gui_.key('n');
  EXPECT_FALSE(gui_.has("outline")) << "the user has folded it";
}

TEST_F(Replay, the_inspector_stays_where_it_is_from_frame_to_frame) {
  model_.state.selected = busiest_grain(model_);
  model_.go_to(0);
  gui_.settle();
  gui_.key('R');
  const gui::WidgetPlace circle = gui_.place("mohr circle"), curve = gui_.place("neighbourhood");
  for (std::size_t frame = 1; frame < model_.frame_count(); ++frame) {
    model_.go_to(frame);
    gui_.settle();
    EXPECT_EQ(gui_.place("mohr circle").y0, circle.y0) << frame;
    EXPECT_EQ(gui_.place("neighbourhood").y0, curve.y0) << frame;
  }
}

}  // namespace
}  // namespace talus
