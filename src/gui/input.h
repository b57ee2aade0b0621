#pragma once
/// Passes mouse and keyboard input to Dear ImGui, with or without a window.

#include <imgui.h>

#include <deque>

namespace talus::gui {

/// Key codes of GLFW: printable keys have their ASCII code, letters as capitals.
enum KeyCode : int {
  key_space = 32,
  key_escape = 256,
  key_enter = 257,
  key_tab = 258,
  key_backspace = 259,
  key_insert = 260,
  key_delete = 261,
  key_right = 262,
  key_left = 263,
  key_down = 264,
  key_up = 265,
  key_page_up = 266,
  key_page_down = 267,
  key_home = 268,
  key_end = 269,
  key_keypad_enter = 335,
  key_left_shift = 340,
  key_left_control = 341,
  key_left_alt = 342,
  key_left_super = 343,
  key_right_shift = 344,
  key_right_super = 347,
};

/// One input event.
struct InputEvent {
  enum class Kind { position, button, wheel, key, character };
  Kind kind = Kind::position;
  float x = 0.0f, y = 0.0f;  ///< position in px; wheel in steps
  int code = 0;              ///< button (0 left, 1 right, 2 middle), key, or Unicode character
  bool down = false;         ///< for buttons and keys
};

/// Delivers events without loss: a button or key that is pressed and released between two pictures is down in
/// one of them.
class InputQueue {
 public:
  void add(const InputEvent& event) { events_.push_back(event); }
  /// Returns whether events remain for a later picture.
  bool waiting() const { return !events_.empty(); }
  /// Delivers the events of one picture; call before ImGui::NewFrame.
  void forward_events(ImGuiIO& io);

 private:
  std::deque<InputEvent> events_;
};

}  // namespace talus::gui
