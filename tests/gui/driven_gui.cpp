#include "gui/driven_gui.h"

#include <algorithm>
#include <cctype>
#include <fmt/core.h>

#include "base/errors.h"

namespace talus::test {
namespace {

float between(float low, float high, float share) { return low + share * (high - low); }

}  // namespace

bool DrivenGui::has(std::string_view name) const {
  return std::ranges::any_of(places(), [name](const gui::WidgetPlace& place) { return place.name == name; });
}

gui::WidgetPlace DrivenGui::place(std::string_view name) const {
  for (const gui::WidgetPlace& place : places())
    if (place.name == name) return place;
  std::string known;
  for (const gui::WidgetPlace& place : places()) known += (known.empty() ? "" : ", ") + place.name;
  throw Error(ExitCode::internal, fmt::format("no widget \"{}\" in the window; there are: {}", name, known));
}

void DrivenGui::move(float x, float y) {
  input().add({gui::InputEvent::Kind::position, x, y, 0, false});
  settle();
}

void DrivenGui::press(int button, bool down) {
  input().add({gui::InputEvent::Kind::button, 0.0f, 0.0f, button, down});
}

void DrivenGui::press_key(int key, bool down) {
  input().add({gui::InputEvent::Kind::key, 0.0f, 0.0f, key, down});
}

void DrivenGui::click(std::string_view name, float share_x, float share_y) {
  const gui::WidgetPlace at = place(name);
  move(between(at.x0, at.x1, share_x), between(at.y0, at.y1, share_y));
  press(0, true);
  press(0, false);
  settle();
}

void DrivenGui::double_click(std::string_view name, float share_x, float share_y) {
  const gui::WidgetPlace at = place(name);
  move(between(at.x0, at.x1, share_x), between(at.y0, at.y1, share_y));
  for (const bool down : {true, false, true, false}) press(0, down);
  settle();
}

void DrivenGui::drag(std::string_view name, float from_x, float from_y, float to_x, float to_y, int button) {
  const gui::WidgetPlace at = place(name);
  move(between(at.x0, at.x1, from_x), between(at.y0, at.y1, from_y));
  press(button, true);
  settle();
  constexpr int parts = 4;
  for (int k = 1; k <= parts; ++k) {
    const float share = static_cast<float>(k) / parts;
    move(between(at.x0, at.x1, between(from_x, to_x, share)),
         between(at.y0, at.y1, between(from_y, to_y, share)));
  }
  press(button, false);
  settle();
}

void DrivenGui::take(std::string_view name, float share_x, float share_y) {
  const gui::WidgetPlace at = place(name);
  move(between(at.x0, at.x1, share_x), between(at.y0, at.y1, share_y));
  press_key(gui::key_left_control, true);
  press(0, true);
  settle();
}

void DrivenGui::release_mouse() {
  press(0, false);
  press_key(gui::key_left_control, false);
  settle();
}

void DrivenGui::scroll(std::string_view name, float steps, float share_x, float share_y) {
  const gui::WidgetPlace at = place(name);
  move(between(at.x0, at.x1, share_x), between(at.y0, at.y1, share_y));
  input().add({gui::InputEvent::Kind::wheel, 0.0f, steps, 0, false});
  settle();
}

void DrivenGui::key(int code, bool control) {
  const bool printable = code > gui::key_space && code < 127;
  const int number = printable ? std::toupper(code) : code;
  if (control) press_key(gui::key_left_control, true);
  press_key(number, true);
  if ((printable || code == gui::key_space) && !control)
    input().add({gui::InputEvent::Kind::character, 0.0f, 0.0f, code, false});
  press_key(number, false);
  if (control) press_key(gui::key_left_control, false);
  settle();
}

void DrivenGui::hold(int key, bool down) {
  press_key(key, down);
  settle();
}

void DrivenGui::type(std::string_view text) {
  for (const char character : text) key(static_cast<unsigned char>(character));
}

}  // namespace talus::test
