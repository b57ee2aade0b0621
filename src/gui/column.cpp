/// Left column: foldable groups of widgets.

#include <algorithm>
#include <fmt/core.h>
#include <string>
#include <utility>

#include "gui/panels.h"

namespace talus::gui {
namespace {

/// Group of widgets, with the key that unfolds it and scrolls to it.
struct Group {
  const char* name;
  void (*draw)(Gui&);
  char key;
  bool unfolded;  ///< initial state, if there is room
};

constexpr Group groups[] = {{"run", draw_run_panel, 'R', true},
                            {"map", draw_map_panel, 'M', true},
                            {"act", draw_action_panel, 'A', false},
                            {"files", draw_file_panel, 'F', false},
                            {"grain", draw_inspector, 'G', false}};

/// Column height below which only one group is unfolded at a time.
constexpr float room_for_several = 40.0f;  // em

/// Draws the heading of a group with its key; returns whether the group is unfolded.
bool draw_heading(Gui& gui, const Group& group) {
  ImGui::PushStyleColor(ImGuiCol_Header, packed(gui.colours.raised));
  const bool unfolded = ImGui::CollapsingHeader(group.name);
  ImGui::PopStyleColor();
  note_place(gui, std::string("group ").append(group.name));
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  const char key[] = {group.key, '\0'};
  ImGui::GetWindowDrawList()->AddText({high.x - 1.4f * gui.em, low.y + ImGui::GetStyle().FramePadding.y},
                                      packed(gui.colours.soft), key);
  return unfolded;
}

/// Scrolls as little as possible to show everything from top to bottom, or else the top.
void scroll_to_show(float top, float bottom) {
  const float from = ImGui::GetScrollY(), room = ImGui::GetWindowHeight();
  if (top < from)
    ImGui::SetScrollY(top);
  else if (bottom > from + room)
    ImGui::SetScrollY(std::min(top, bottom - room));
}

void draw_group(Gui& gui, const Group& group, bool several) {
  const bool asked = gui.panel_asked == group.name;
  const bool another_asked = !gui.panel_asked.empty() && !asked;
  if (asked || (another_asked && !several))
    ImGui::SetNextItemOpen(asked);
  else
    ImGui::SetNextItemOpen(group.unfolded && (several || group.draw == draw_run_panel), ImGuiCond_Once);
  const float top = ImGui::GetCursorPosY();
  const bool unfolded = draw_heading(gui, group);
  // A click on a heading acts as its key does, one picture later, so that only one place folds and scrolls.
  if (unfolded && ImGui::IsItemToggledOpen()) gui.model.state.panel_asked = group.name;
  if (!unfolded) return;
  group.draw(gui);
  ImGui::Dummy({0.0f, 0.3f * gui.em});
  if (!asked) return;
  scroll_to_show(top, ImGui::GetCursorPosY());
  gui.model.state.message = fmt::format("Unfolded: {}.", group.name);
}

}  // namespace

const char* group_of_key(ImWchar key) {
  const auto* const found =
      std::ranges::find(groups, key, [](const Group& group) { return static_cast<ImWchar>(group.key); });
  return found == std::end(groups) ? "" : found->name;
}

void draw_column(Gui& gui, bool with_inspector) {
  ImGui::BeginChild("column");
  const bool several = ImGui::GetWindowHeight() >= room_for_several * gui.em;
  if (!with_inspector && gui.panel_asked == group_of_key('G')) {
    gui.panel_asked.clear();
    gui.model.state.message = "The selected grain is shown in the column on the right.";
  }
  for (const Group& group : groups)
    if (with_inspector || group.draw != draw_inspector) draw_group(gui, group, several);
  ImGui::EndChild();
}

}  // namespace talus::gui
