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

/// Returns whether `key` is the left or right key of a pair; in GLFW the code of the right key is larger by
/// 4.
bool is_modifier(int key, int left) { return key == left || key == left + 4; }

}  // namespace

#if IMGUI_VERSION_NUM < 18700  // the state of input is written by the program, under its own key codes

namespace {

void set_key(ImGuiIO& io, int key, bool down) {
  if (key < 0 || key >= IM_ARRAYSIZE(io.KeysDown)) return;
  io.KeysDown[key] = down;
  if (is_modifier(key, key_left_shift)) io.KeyShift = down;
  if (is_modifier(key, key_left_control)) io.KeyCtrl = down;
  if (is_modifier(key, key_left_alt)) io.KeyAlt = down;
  if (is_modifier(key, key_left_super)) io.KeySuper = down;
}

}  // namespace

void prepare_input(ImGuiIO& io) {
  for (const NamedKey& named : named_keys) io.KeyMap[named.name] = named.key;
}

bool key_pressed(KeyCode key, bool repeat) { return ImGui::IsKeyPressed(key, repeat); }

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

#else  // the program adds events to a queue of ImGui, under its key codes

namespace {

ImGuiKey name_of(int key) {
  for (const NamedKey& named : named_keys)
    if (named.key == key) return named.name;
  return ImGuiKey_None;
}

void add_key(ImGuiIO& io, int key, bool down) {
  if (const ImGuiKey name = name_of(key); name != ImGuiKey_None) io.AddKeyEvent(name, down);
  if (is_modifier(key, key_left_shift)) io.AddKeyEvent(ImGuiMod_Shift, down);
  if (is_modifier(key, key_left_control)) io.AddKeyEvent(ImGuiMod_Ctrl, down);
  if (is_modifier(key, key_left_alt)) io.AddKeyEvent(ImGuiMod_Alt, down);
  if (is_modifier(key, key_left_super)) io.AddKeyEvent(ImGuiMod_Super, down);
}

}  // namespace

void prepare_input(ImGuiIO& io) { io.ConfigInputTrickleEventQueue = false; }  // InputQueue spreads events

bool key_pressed(KeyCode key, bool repeat) { return ImGui::IsKeyPressed(name_of(key), repeat); }

void forward_event(ImGuiIO& io, const InputEvent& event) {
  switch (event.kind) {
    case InputEvent::Kind::position:
      io.AddMousePosEvent(event.x, event.y);
      break;
    case InputEvent::Kind::button:
      if (event.code < ImGuiMouseButton_COUNT) io.AddMouseButtonEvent(event.code, event.down);
      break;
    case InputEvent::Kind::wheel:
      io.AddMouseWheelEvent(event.x, event.y);
      break;
    case InputEvent::Kind::key:
      add_key(io, event.code, event.down);
      break;
    case InputEvent::Kind::character:
      io.AddInputCharacter(static_cast<unsigned>(event.code));
      break;
  }
}

#endif

void keep_wheel() {
#if IMGUI_VERSION_NUM < 18900
  ImGui::SetItemUsingMouseWheel();
#else
  ImGui::SetItemKeyOwner(ImGuiKey_MouseWheelY);
#endif
}

#if IMGUI_VERSION_NUM < 19200

ImTextureID font_texture(const ImFontAtlas& atlas) { return atlas.TexID; }
float font_size(const ImFont& font) { return font.FontSize; }
bool has_letter(ImFont& font, ImWchar letter) { return font.FindGlyphNoFallback(letter) != nullptr; }
void push_font(ImFont& font) { ImGui::PushFont(&font); }
void scale_fonts(float scale) { ImGui::GetIO().FontGlobalScale = scale; }

#else

ImTextureID font_texture(const ImFontAtlas& atlas) { return atlas.TexRef.GetTexID(); }
float font_size(const ImFont& font) { return font.LegacySize; }
bool has_letter(ImFont& font, ImWchar letter) {
  return font.GetFontBaked(font.LegacySize)->FindGlyphNoFallback(letter) != nullptr;
}
void push_font(ImFont& font) { ImGui::PushFont(&font, font.LegacySize); }
void scale_fonts(float scale) { ImGui::GetStyle().FontScaleMain = scale; }

#endif

}  // namespace talus::gui
