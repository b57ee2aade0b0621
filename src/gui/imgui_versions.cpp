#include "gui/imgui_versions.h"

#include <imgui_internal.h>

namespace talus::gui {
namespace {

#if IMGUI_VERSION_NUM < 18700
constexpr ImGuiKey enter_of_keypad = ImGuiKey_KeyPadEnter;
#else
constexpr ImGuiKey enter_of_keypad = ImGuiKey_KeypadEnter;
#endif

struct NamedKey {
  ImGuiKey name;
  int key;
};

/// Keys that ImGui uses for navigation and editing, and those of the window that are no characters.
constexpr NamedKey named_keys[] = {{ImGuiKey_Tab, key_tab},
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
                                   {enter_of_keypad, key_keypad_enter},
                                   {ImGuiKey_A, 'A'},
                                   {ImGuiKey_C, 'C'},
                                   {ImGuiKey_V, 'V'},
                                   {ImGuiKey_X, 'X'},
                                   {ImGuiKey_Y, 'Y'},
                                   {ImGuiKey_Z, 'Z'}};

#if IMGUI_VERSION_NUM < 18700  // the state of input is written by the program, under its own key codes

int code_of(KeyCode key) { return key; }
void move_mouse(ImGuiIO& io, float x, float y) { io.MousePos = {x, y}; }
void set_button(ImGuiIO& io, int button, bool down) { io.MouseDown[button] = down; }
void turn_wheel(ImGuiIO& io, float x, float y) {
  io.MouseWheelH += x;
  io.MouseWheel += y;
}
void set_key(ImGuiIO& io, int key, bool down) {
  if (key >= 0 && key < IM_ARRAYSIZE(io.KeysDown)) io.KeysDown[key] = down;
}
constexpr bool ImGuiIO::*modifiers[] = {&ImGuiIO::KeyShift, &ImGuiIO::KeyCtrl, &ImGuiIO::KeyAlt,
                                        &ImGuiIO::KeySuper};
void set_modifier(ImGuiIO& io, bool ImGuiIO::*modifier, bool down) { io.*modifier = down; }

#else  // the program adds events to a queue of ImGui, under its key codes

ImGuiKey code_of(int key) {
  for (const NamedKey& named : named_keys)
    if (named.key == key) return named.name;
  return ImGuiKey_None;
}
void move_mouse(ImGuiIO& io, float x, float y) { io.AddMousePosEvent(x, y); }
void set_button(ImGuiIO& io, int button, bool down) { io.AddMouseButtonEvent(button, down); }
void turn_wheel(ImGuiIO& io, float x, float y) { io.AddMouseWheelEvent(x, y); }
void set_key(ImGuiIO& io, int key, bool down) {
  if (const ImGuiKey name = code_of(key); name != ImGuiKey_None) io.AddKeyEvent(name, down);
}
#if IMGUI_VERSION_NUM < 18900
constexpr ImGuiKey modifiers[] = {ImGuiKey_ModShift, ImGuiKey_ModCtrl, ImGuiKey_ModAlt, ImGuiKey_ModSuper};
#else
constexpr ImGuiKey modifiers[] = {ImGuiMod_Shift, ImGuiMod_Ctrl, ImGuiMod_Alt, ImGuiMod_Super};
#endif
void set_modifier(ImGuiIO& io, ImGuiKey modifier, bool down) { io.AddKeyEvent(modifier, down); }

#endif

}  // namespace

void prepare_input(ImGuiIO& io) {
#if IMGUI_VERSION_NUM < 18700
  for (const NamedKey& named : named_keys) io.KeyMap[named.name] = named.key;
#else
  io.ConfigInputTrickleEventQueue = false;  // InputQueue spreads events
#endif
}

bool key_pressed(KeyCode key, bool repeat) { return ImGui::IsKeyPressed(code_of(key), repeat); }

void forward_event(ImGuiIO& io, const InputEvent& event) {
  switch (event.kind) {
    case InputEvent::Kind::position:
      return move_mouse(io, event.x, event.y);
    case InputEvent::Kind::button:
      if (event.code < ImGuiMouseButton_COUNT) set_button(io, event.code, event.down);
      return;
    case InputEvent::Kind::wheel:
      return turn_wheel(io, event.x, event.y);
    case InputEvent::Kind::key:
      set_key(io, event.code, event.down);
      // GLFW: shift, control, alt and super follow each other, first those on the left, then those on the
      // right.
      for (int k = 0; k < IM_ARRAYSIZE(modifiers); ++k)
        if (event.code == key_left_shift + k || event.code == key_left_shift + k + 4)
          set_modifier(io, modifiers[k], event.down);
      return;
    case InputEvent::Kind::character:
      return io.AddInputCharacter(static_cast<unsigned>(event.code));
  }
}

void keep_wheel() {
#if IMGUI_VERSION_NUM < 18900
  ImGui::SetItemUsingMouseWheel();
#else
  ImGui::SetItemKeyOwner(ImGuiKey_MouseWheelY);
#endif
}

#if IMGUI_VERSION_NUM < 19200

void push_font(ImFont& font) { ImGui::PushFont(&font); }
void scale_fonts(float scale) { ImGui::GetIO().FontGlobalScale = scale; }

#else

void push_font(ImFont& font) { ImGui::PushFont(&font, font.LegacySize); }
void scale_fonts(float scale) { ImGui::GetStyle().FontScaleMain = scale; }

#endif

void InputQueue::forward_events(ImGuiIO& io) {
  bool pressed = false;  // after a button or key has changed, only its own character may follow
  while (!events_.empty()) {
    const InputEvent& event = events_.front();
    if (pressed && event.kind != InputEvent::Kind::character) break;
    pressed = pressed || event.kind == InputEvent::Kind::button || event.kind == InputEvent::Kind::key;
    forward_event(io, event);
    events_.pop_front();
  }
}

}  // namespace talus::gui
