#pragma once
/// Mouse and keyboard input for Dear ImGui, with or without a window, and the differences between its
/// versions 1.86 to 1.92: keys, input, textures and fonts. The window uses what they share.

#include <imgui.h>

#include <cstdint>
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
};

/// One input event.
struct InputEvent {
  enum class Kind { position, button, wheel, key, character };
  Kind kind = Kind::position;
  float x = 0.0f, y = 0.0f;  ///< position in px; wheel in steps
  int code = 0;              ///< button (0 left, 1 right, 2 middle), key, or Unicode character
  bool down = false;         ///< for buttons and keys
};

/// Delivers events without loss: a button clicked between two pictures is down in one of them.
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

/// Prepares a new ImGui context for the events of an InputQueue.
void prepare_input(ImGuiIO& io);
/// Passes one event on; it takes effect in the next ImGui::NewFrame.
void forward_event(ImGuiIO& io, const InputEvent& event);
/// Whether a key is pressed in this picture, or repeats because it is held.
bool key_pressed(KeyCode key, bool repeat = true);
/// Keeps the mouse wheel for the last widget, so that the part around it does not scroll as well.
void keep_wheel();

/// The id of an OpenGL texture.
inline ImTextureID texture_id(unsigned texture) { return (ImTextureID)std::uintptr_t{texture}; }
inline unsigned texture_number(ImTextureID id) { return (unsigned)(std::uintptr_t)id; }

/// Sets the current font until ImGui::PopFont, in its own size.
void push_font(ImFont& font);
/// Scales all fonts when they are drawn. Call it after the style has been set.
void scale_fonts(float scale);

}  // namespace talus::gui
