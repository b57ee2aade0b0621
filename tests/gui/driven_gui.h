#pragma once
/// The window without a display, controlled like a user would.

#include <string_view>

#include "gui/screen.h"

namespace talus::test {

class DrivenGui : public gui::OffscreenGui {
 public:
  using gui::OffscreenGui::OffscreenGui;

  bool has(std::string_view name) const;
  /// Returns the place of a widget. Throws Error(internal) if none has that name.
  gui::WidgetPlace place(std::string_view name) const;

  // User actions, each followed by settling. A place inside a widget is given as shares of its width and
  // height.
  void move(float x, float y);
  void click(std::string_view name, float share_x = 0.5f, float share_y = 0.5f);
  void double_click(std::string_view name, float share_x = 0.5f, float share_y = 0.5f);
  void drag(std::string_view name, float from_x, float from_y, float to_x, float to_y, int button = 0);
  /// Presses the left button there with ctrl held, until release_mouse.
  void take(std::string_view name, float share_x, float share_y);
  void release_mouse();
  void scroll(std::string_view name, float steps, float share_x = 0.5f, float share_y = 0.5f);
  /// Presses a printable ASCII character or a value of KeyCode.
  void key(int code, bool control = false);
  void type(std::string_view text);
  /// Holds or releases a key such as key_left_shift.
  void hold(int key, bool down);

 private:
  void press(int button, bool down);
  void press_key(int key, bool down);
};

}  // namespace talus::test
