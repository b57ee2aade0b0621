#include <cmath>
#include <string>

#include "gui/widgets.h"

namespace talus::gui {
namespace {

/// Adds a triangle that points to the right (1) or to the left (-1).
void add_triangle(ImDrawList& list, const ImVec2& middle, float half, float side, ImU32 ink) {
  const ImVec2 tip{middle.x + 0.9f * side * half, middle.y};
  const float back = middle.x - 0.9f * side * half;
  list.AddTriangleFilled(tip, {back, middle.y - half}, {back, middle.y + half}, ink);
}

void add_bar(ImDrawList& list, float x, float y, float half, float width, ImU32 ink) {
  list.AddRectFilled({x - 0.5f * width, y - half}, {x + 0.5f * width, y + half}, ink);
}

void add_icon(ImDrawList& list, Icon icon, const ImVec2& middle, float em, ImU32 ink) {
  const float half = 0.36f * em, bar = std::max(1.0f, std::round(0.16f * em)), apart = 0.3f * em;
  switch (icon) {
    case Icon::play:
      return add_triangle(list, middle, 1.15f * half, 1.0f, ink);
    case Icon::pause:
      add_bar(list, middle.x - 0.6f * apart, middle.y, half, 1.3f * bar, ink);
      return add_bar(list, middle.x + 0.6f * apart, middle.y, half, 1.3f * bar, ink);
    case Icon::back:
      return add_triangle(list, middle, 0.8f * half, -1.0f, ink);
    case Icon::forward:
      return add_triangle(list, middle, 0.8f * half, 1.0f, ink);
    case Icon::first:
      add_bar(list, middle.x - 1.2f * apart, middle.y, half, bar, ink);
      return add_triangle(list, {middle.x + 0.2f * apart, middle.y}, half, -1.0f, ink);
    case Icon::last:
      add_bar(list, middle.x + 1.2f * apart, middle.y, half, bar, ink);
      return add_triangle(list, {middle.x - 0.2f * apart, middle.y}, half, 1.0f, ink);
  }
}

}  // namespace

bool icon_button(Gui& gui, const char* name, Icon icon, const char* tip) {
  const bool pressed = ImGui::Button(std::string("##").append(name).c_str(), {2.2f * gui.em, 0.0f});
  note_place(gui, name);
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  add_icon(*ImGui::GetWindowDrawList(), icon, {0.5f * (low.x + high.x), 0.5f * (low.y + high.y)}, gui.em,
           ImGui::GetColorU32(ImGuiCol_Text));
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", tip);
  return pressed;
}

}  // namespace talus::gui
