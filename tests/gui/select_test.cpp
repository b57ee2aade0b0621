/// Selection in the window without a display: clicks and drags with shift and ctrl, the range of the bar, the
/// inspector of contacts.

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include "gui/offscreen_fixture.h"

namespace talus {
namespace {

using test::Replay;

TEST_F(Replay, shift_selects_more_grains) {
  const auto click = [&](Index grain) {
    const auto [x, y] = share_of(grain);
    gui_.click("map", x, y);
  };
  click(7);
  gui_.hold(gui::key_left_shift, true);
  click(31);
  click(12);
  EXPECT_EQ(model_.selected_grains(), (std::vector<Index>{7, 12, 31}));
  click(31);
  EXPECT_EQ(model_.selected_grains(), (std::vector<Index>{7, 12})) << "the second click removes it";
  gui_.hold(gui::key_left_shift, false);
  click(31);
  EXPECT_EQ(model_.selected_grains(), (std::vector<Index>{31})) << "a plain click selects one";
}

TEST_F(Replay, a_box_selects_and_moves_nothing) {
  gui_.scroll("map", 2.0f);  // a zoomed map, in which dragging would move the picture
  const std::vector<gui::WidgetPlace> before = gui_.places();
  const view::ViewCamera camera = model_.state.camera;
  gui_.hold(gui::key_left_shift, true);
  gui_.drag("map", 0.6f, 0.0f, 1.0f, 1.0f);
  const std::vector<Index> right = model_.selected_grains();
  gui_.drag("map", 0.0f, 0.0f, 0.5f, 1.0f);
  gui_.hold(gui::key_left_shift, false);
  std::vector<Index> selected = model_.selected_grains();
  std::vector<Index> left;
  const gui::WidgetPlace map = gui_.place("map");
  const double aspect = static_cast<double>(map.x1 - map.x0) / static_cast<double>(map.y1 - map.y0);
  const auto [x_min, x_max, y_min, y_max] = model_.first().part(aspect);
  for (Index i = 0; i < model_.statics().free_count; ++i) {
    const double x = model_.frame().x[static_cast<std::size_t>(i)],
                 y = model_.frame().y[static_cast<std::size_t>(i)];
    // Grains on the edge of the box may be inside or outside.
    if (std::abs(x - 0.5 * (x_min + x_max)) < (x_max - x_min) / static_cast<double>(map.x1 - map.x0))
      std::erase(selected, i);
    else if (x > x_min && x < 0.5 * (x_min + x_max) && y > y_min && y < y_max)
      left.push_back(i);
  }
  EXPECT_GT(left.size(), 2u);
  EXPECT_FALSE(right.empty());
  EXPECT_EQ(selected, left) << "the second box replaces the first";
  EXPECT_EQ(model_.state.camera.centre_x, camera.centre_x);
  expect_unmoved(before);
}

TEST_F(Replay, ctrl_draws_a_lasso_and_picks_contacts) {
  gui_.hold(gui::key_left_control, true);
  gui_.drag("map", 0.2f, 0.2f, 0.8f, 0.8f);
  EXPECT_TRUE(model_.selected_grains().empty()) << "a straight line contains nothing";
  const auto [x, y] = share_of(7);
  gui_.click("map", x, y);
  gui_.hold(gui::key_left_control, false);
  const auto contact = model_.state.selecting.selection.contact;
  ASSERT_TRUE(contact);
  EXPECT_TRUE(contact->a == 7 || contact->b == 7);
  EXPECT_FALSE(model_.state.selected);
  gui_.key(gui::key_escape);
  EXPECT_FALSE(model_.state.selecting.selection.contact);
}

TEST_F(Replay, grains_within_the_range_of_the_bar_are_selected) {
  model_.state.map.layers = {pictures::MapKind::pressure};
  gui_.key('M');
  EXPECT_FALSE(gui_.has("select range")) << "there is no range";
  gui_.click("range");
  const std::vector<double> values = model_.first().bar()->values;
  ASSERT_EQ(values.size(), static_cast<std::size_t>(model_.statics().free_count));
  std::vector<double> sorted = values;
  std::ranges::sort(sorted);
  model_.state.map.range_low = sorted[10];
  model_.state.map.range_high = sorted[19];
  gui_.settle();
  gui_.click("select range");
  std::vector<Index> within;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (sorted[10] <= values[i] && values[i] <= sorted[19]) within.push_back(static_cast<Index>(i));
  EXPECT_EQ(within.size(), 10u);
  EXPECT_EQ(model_.selected_grains(), within);
  model_.select(std::optional<Index>(7));
  model_.state.map.range_low = -2.0;
  model_.state.map.range_high = -1.0;
  gui_.settle();
  gui_.key('M');
  gui_.click("select range");
  EXPECT_TRUE(model_.selected_grains().empty()) << "it replaces the selection";
}

TEST_F(Replay, contacts_and_grains_lead_to_each_other) {
  gui_.resize(1400, 1800);
  model_.select(std::optional<Index>(12));
  gui_.settle();
  const std::vector<view::GrainContact> contacts = model_.first().inspection()->contacts;
  ASSERT_FALSE(contacts.empty());
  gui_.click("contact with " + contacts[0].other_name);
  ASSERT_EQ(model_.state.selecting.selection.contact, std::optional(contacts[0].key));
  EXPECT_DOUBLE_EQ(model_.contact_inspection()->fn, contacts[0].fn);
  EXPECT_TRUE(gui_.has("cone"));
  for (int wait = 0; wait < 500 && !gui_.has("plot mobilisation"); ++wait) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    gui_.frame();
  }
  gui_.settle();
  gui_.click("plot contact forces", 0.95f, 0.5f);
  EXPECT_EQ(model_.frame_index(), 4u) << "the frame there";
  gui_.click(contacts[0].key.a == 12 ? "first body" : "second body");
  EXPECT_EQ(model_.state.selected, std::optional<Index>(12));
  EXPECT_FALSE(gui_.has("cone"));
}

TEST_F(Replay, the_picture_follows_a_grain_until_it_is_moved) {
  gui_.key('L');
  EXPECT_FALSE(model_.state.selecting.follow) << "there is no grain to follow";
  gui_.key('n');
  gui_.scroll("map", 4.0f);
  gui_.key('L');
  EXPECT_TRUE(model_.state.selecting.follow);
  gui_.drag("map", 0.5f, 0.5f, 0.3f, 0.5f);
  EXPECT_FALSE(model_.state.selecting.follow);
}

}  // namespace
}  // namespace talus
