#include "gui/input.h"

#include <array>

namespace talus::gui {
namespace {

struct NamedKey {
  ImGuiKey name;
  int key;
};

/// Keys that ImGui uses for navigation and editing.
constexpr std::array<NamedKey, 22> named_keys = {{{ImGuiKey_Tab, key_tab},
                                                  {ImGuiKey_LeftArrow, key_left},
                                                  {ImGuiKey_RightArrow, key_right},
                                                  {ImGuiKey_UpArrow, key_up},
                                                  {ImGuiKey_DownArrow, key_down},
                                                  {ImGuiKey_PageUp, key_page_up},
                                                  {ImGuiKey_PageDown, key_page_down},
                                                  {ImGuiKey_Home, key_home},
                                                  {ImGuiKey_End, key_end},
                                                  {ImGuiKey_Insert, key_insert},
                                                  {ImGuiKey_Delete, key_delete},
                                                  {ImGuiKey_Backspace, key_backspace},
                                                  {ImGuiKey_Space, key_space},
                                                  {ImGuiKey_Enter, key_enter},
                                                  {ImGuiKey_Escape, key_escape},
                                                  {ImGuiKey_KeyPadEnter, key_keypad_enter},
                                                  {ImGuiKey_A, 'A'},
                                                  {ImGuiKey_C, 'C'},
                                                  {ImGuiKey_V, 'V'},
                                                  {ImGuiKey_X, 'X'},
                                                  {ImGuiKey_Y, 'Y'},
                                                  {ImGuiKey_Z, 'Z'}}};

/// Returns whether `key` is the left or right key of a pair; in GLFW the code of the right key is larger by
/// 4.
bool is_modifier(int key, int left) { return key == left || key == left + 4; }

void set_key(ImGuiIO& io, int key, bool down) {
  if (key < 0 || key >= IM_ARRAYSIZE(io.KeysDown)) return;
  io.KeysDown[key] = down;
  if (is_modifier(key, key_left_shift)) io.KeyShift = down;
  if (is_modifier(key, key_left_control)) io.KeyCtrl = down;
  if (is_modifier(key, key_left_alt)) io.KeyAlt = down;
  if (is_modifier(key, key_left_super)) io.KeySuper = down;
}

void forward_event(ImGuiIO& io, const InputEvent& event) {
  switch (event.kind) {
    case InputEvent::Kind::position:
      io.MousePos = {event.x, event.y};
      break;
    case InputEvent::Kind::button:
      if (event.code < IM_ARRAYSIZE(io.MouseDown)) io.MouseDown[event.code] = event.down;
      break;
    case InputEvent::Kind::wheel:
      io.MouseWheelH += event.x;
      io.MouseWheel += event.y;
      break;
    case InputEvent::Kind::key:
      set_key(io, event.code, event.down);
      break;
    case InputEvent::Kind::character:
      io.AddInputCharacter(static_cast<unsigned>(event.code));
      break;
  }
}

}  // namespace

void name_keys(ImGuiIO& io) {
  for (const NamedKey& named : named_keys) io.KeyMap[named.name] = named.key;
}

void InputQueue::forward_events(ImGuiIO& io) {
  bool pressed =
      false;  // after a button or key has changed, only its own character may follow in this picture
  while (!events_.empty()) {
    const InputEvent& event = events_.front();
    if (pressed && event.kind != InputEvent::Kind::character) break;
    pressed = pressed || event.kind == InputEvent::Kind::button || event.kind == InputEvent::Kind::key;
    forward_event(io, event);
    events_.pop_front();
  }
}

}  // namespace talus::gui
