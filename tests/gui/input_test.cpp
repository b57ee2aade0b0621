/// Clicks and keys are not lost, however fast they are.

#include <gtest/gtest.h>

#include "gui/imgui_versions.h"

namespace talus {
namespace {

using Kind = gui::InputEvent::Kind;

class Input : public testing::Test {
 protected:
  Input() : imgui_(ImGui::CreateContext()) {
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.DisplaySize = {100, 100};
    io.Fonts->Build();
    gui::prepare_input(io);
  }
  ~Input() override { ImGui::DestroyContext(imgui_); }

  void button(bool down) { queue_.add({Kind::button, 0.0f, 0.0f, 0, down}); }
  void key(int key, bool down) { queue_.add({Kind::key, 0.0f, 0.0f, key, down}); }
  void position(float x, float y) { queue_.add({Kind::position, x, y, 0, false}); }

  /// Simulates one picture.
  void picture() {
    queue_.forward_events(ImGui::GetIO());
    ImGui::NewFrame();
    clicks_ += ImGui::IsMouseClicked(0) ? 1 : 0;
    enters_ += gui::key_pressed(gui::key_enter, false) ? 1 : 0;
    for (const ImWchar c : ImGui::GetIO().InputQueueCharacters) typed_.push_back(static_cast<char>(c));
    ImGui::EndFrame();
  }
  void pictures(int count) {
    for (int k = 0; k < count; ++k) picture();
  }

  ImGuiContext* imgui_;
  gui::InputQueue queue_;
  int clicks_ = 0, enters_ = 0;
  std::string typed_;
};

TEST_F(Input, two_clicks_between_two_pictures_are_two_clicks) {
  for (const bool down : {true, false, true, false}) button(down);
  pictures(6);
  EXPECT_EQ(clicks_, 2);
  EXPECT_FALSE(queue_.waiting());
}

TEST_F(Input, a_key_that_is_up_again_was_down) {
  for (const bool down : {true, false, true, false}) key(gui::key_enter, down);
  pictures(6);
  EXPECT_EQ(enters_, 2);
}

TEST_F(Input, a_click_is_where_the_mouse_was) {
  position(10, 20);
  button(true);
  position(50, 60);
  picture();
  EXPECT_EQ(clicks_, 1);
  EXPECT_EQ(ImGui::GetIO().MousePos.x, 10.0f);
  EXPECT_TRUE(queue_.waiting());
  picture();
  EXPECT_EQ(ImGui::GetIO().MousePos.x, 50.0f);
}

TEST_F(Input, a_character_comes_with_its_key) {
  key(gui::key_left_shift, true);
  key('/', true);
  queue_.add({Kind::character, 0.0f, 0.0f, '?', false});
  key('/', false);
  key(gui::key_left_shift, false);
  picture();
  EXPECT_TRUE(ImGui::GetIO().KeyShift);
  EXPECT_EQ(typed_, "");
  picture();
  EXPECT_EQ(typed_, "?");
  EXPECT_TRUE(ImGui::GetIO().KeyShift);
  pictures(2);
  EXPECT_FALSE(ImGui::GetIO().KeyShift);
  EXPECT_EQ(typed_, "?");
}

TEST_F(Input, wheel_steps_add_up) {
  queue_.add({Kind::wheel, 0.0f, 1.0f, 0, false});
  queue_.add({Kind::wheel, 0.5f, 2.0f, 0, false});
  queue_.forward_events(ImGui::GetIO());
  ImGui::NewFrame();
  EXPECT_EQ(ImGui::GetIO().MouseWheel, 3.0f);
  EXPECT_EQ(ImGui::GetIO().MouseWheelH, 0.5f);
  ImGui::EndFrame();
}

TEST_F(Input, unknown_keys_do_no_harm) {
  key(-1, true);
  key(100000, true);
  pictures(3);
  EXPECT_FALSE(queue_.waiting());
}

}  // namespace
}  // namespace talus
