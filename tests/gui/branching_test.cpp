/// Branches in the window: continuing from a frame, undoing a command, dragging grains.

#include <gtest/gtest.h>

#include "gui/offscreen_fixture.h"

namespace talus {
namespace {

/// Replay from which a branch is made, in a window without a display.
class Branching : public test::Replay {
 protected:
  bool wait_until(const std::function<bool()>& so) { return test::drawn_until(gui_, so); }
  view::LiveStatus status() { return model_.live()->status(); }
  std::string hash() {
    EXPECT_TRUE(wait_until([&] { return !status().running; }));
    return status().state_hash;
  }
};

TEST_F(Branching, a_replay_goes_on_from_the_frame_shown) {
  model_.go_to(std::size_t{2});
  gui_.settle();
  const std::int64_t step = model_.frame().step;
  gui_.key('A');
  gui_.key('N');
  ASSERT_TRUE(model_.is_live());
  EXPECT_EQ(status().step, step);
  gui_.key('R');
  gui_.click("play");
  ASSERT_TRUE(wait_until([&] { return model_.frame_count() > 1; })) << "one frame later";
  gui_.click("play");
  ASSERT_FALSE(hash().empty());
  gui_.click("time line", 0.01f, 0.6f);
  EXPECT_EQ(model_.frame_index(), 0u) << "that with which it begins";
  EXPECT_TRUE(gui_.requests().open_path.empty());
  gui_.click("return to the run");
  EXPECT_EQ(gui_.requests().open_path, folder_.path("bed.h5")) << "the parent run";
  EXPECT_EQ(gui_.requests().open_frame, std::optional<std::size_t>(2));
}

TEST_F(Branching, N_and_U_are_its_keys) {
  gui_.key('N');
  ASSERT_TRUE(model_.is_live());
  const std::string before = hash();
  model_.state.selected = 3;
  for (const bool by_button : {false, true}) {
    gui_.key('u');
    gui_.key(gui::key_right);
    EXPECT_NE(hash(), before);
    gui_.key(by_button ? 'A' : 'U');
    if (by_button) gui_.click("back");
    EXPECT_EQ(hash(), before);
  }
  gui_.key('U');
  EXPECT_NE(model_.state.message.find("no command"), std::string::npos) << model_.state.message;
}

TEST_F(Branching, ctrl_and_the_mouse_drag_a_grain) {
  gui_.key('N');
  const Index grain = 30;
  const auto [x, y] = share_of(grain);
  const auto shown = model_.first().part(1.0);
  const double before_x = model_.frame().x[grain];
  const gui::WidgetPlace map = gui_.place("map");
  gui_.take("map", x, y);
  EXPECT_FALSE(status().dragged) << "a click is meant for a contact";
  gui_.move(map.x0 + x * (map.x1 - map.x0), map.y0 + y * (map.y1 - map.y0) - 6.0f);
  EXPECT_EQ(model_.state.selected, grain);
  EXPECT_EQ(status().dragged, grain);
  for (int k = 1; k <= 5; ++k) {
    model_.live()->step(3);
    hash();
    gui_.move(map.x0 + (x + 0.01f * static_cast<float>(k)) * (map.x1 - map.x0), map.y0 + 0.05f);
  }
  EXPECT_NE(model_.state.message.find("m g"), std::string::npos) << model_.state.message;
  model_.live()->step(3);
  hash();
  gui_.release_mouse();
  EXPECT_FALSE(status().dragged);
  EXPECT_NEAR(model_.first().part(1.0).x_min, shown.x_min, 1e-4) << "the picture is unchanged";
  EXPECT_NEAR(model_.first().part(1.0).y_max, shown.y_max, 1e-4);
  EXPECT_NE(model_.frame().x[grain], before_x);
  const std::vector<Command> commands = model_.live()->commands();
  ASSERT_GE(commands.size(), 4u);
  EXPECT_EQ(commands.front().kind, CommandKind::drag);
  EXPECT_EQ(commands.back().kind, CommandKind::release);
  EXPECT_EQ(status().commands_given, 1u);
}

TEST_F(Branching, ctrl_selects_contacts_and_draws_lassos_too) {
  gui_.key('N');
  const auto [x, y] = share_of(30);
  gui_.take("map", x, y);
  gui_.release_mouse();
  EXPECT_TRUE(model_.state.selecting.selection.contact);
  gui_.hold(gui::key_left_shift, true);
  gui_.take("map", x, y);
  gui_.move(gui_.place("map").x0 + 5.0f, gui_.place("map").y0 + 5.0f);
  EXPECT_EQ(model_.state.selecting.outline.size(), 2u) << "with shift a lasso may begin on a grain too";
  EXPECT_FALSE(model_.state.selecting.outline_is_box);
  gui_.release_mouse();
  gui_.hold(gui::key_left_shift, false);
  gui_.take("map", 0.005f, 0.005f);
  const gui::WidgetPlace map = gui_.place("map");
  for (const auto& [to_x, to_y] : {std::pair(0.995f, 0.005f), {0.995f, 0.995f}, {0.005f, 0.995f}})
    gui_.move(map.x0 + to_x * (map.x1 - map.x0), map.y0 + to_y * (map.y1 - map.y0));
  gui_.release_mouse();
  EXPECT_GT(model_.selected_grains().size(), 10u);
  EXPECT_TRUE(model_.live()->commands().empty());
}

}  // namespace
}  // namespace talus
