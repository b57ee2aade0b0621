#include "gui/gui.h"

#include <algorithm>
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
  if (unfolded && ImGui::IsItemToggledOpen()) gui.state.panel_asked = group.name;
  if (!unfolded) return;
  group.draw(gui);
  ImGui::Dummy({0.0f, 0.3f * gui.em});
  if (asked) scroll_to_show(top, ImGui::GetCursorPosY());
}

constexpr ImGuiWindowFlags fixed = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus;

/// Returns the height that the map does not need, which has at least half of the window, or the height set by
/// the user with the border between map and plots; 0 if there is no room for both.
float height_of_plots(view::ViewModel& model, float width, float height, float em) {
  const float least = 12.0f * em;
  const auto map_height = [&](float picture) {
    return map_area_height(model.first().annotated_map(), width, picture, em);
  };
  const float min_map = std::max(least, map_height(4.0f * em));
  if (!model.state.show_plots || height < 1.1f * (min_map + least)) return 0.0f;
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  const float of_bed = map_height(width / static_cast<float>(model.first().bed_aspect())) *
                       (model.state.second_view.shown ? 2.1f : 1.0f);
  const float wanted = model.state.picture_share > 0.0f
                           ? model.state.picture_share * height
                           : std::max(of_bed, 0.5f * window.x * window.y / width);
  return height - std::clamp(wanted, min_map, height - least);
}

void draw_border(Gui& gui, float top, float height) {
  const ImVec2 corner = ImGui::GetWindowPos();
  const float width = ImGui::GetWindowWidth(), half = 0.3f * gui.em;
  ImGui::SetCursorScreenPos(corner);
  ImGui::InvisibleButton("border", {width, 2.0f * half});
  note_place(gui, "border");
  if (ImGui::IsItemHovered() || ImGui::IsItemActive()) {
    ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeNS);
    ImGui::GetWindowDrawList()->AddRectFilled(corner, {corner.x + width, corner.y + 0.5f * half},
                                              ImGui::GetColorU32(ImGuiCol_ButtonActive));
  }
  if (ImGui::IsItemActive() && ImGui::GetIO().MouseDelta.y != 0.0f)
    gui.state.picture_share = std::clamp((ImGui::GetIO().MousePos.y - top) / height, 0.05f, 0.95f);
  if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(0)) gui.state.picture_share = 0.0f;
}

/// Draws a part of the window at a place.
template <typename Draw>
void part(const char* name, const ImVec2& place, const ImVec2& size, ImGuiWindowFlags flags,
          const Draw& draw) {
  if (size.x < 2.0f || size.y < 2.0f) return;
  ImGui::SetNextWindowPos(place);
  ImGui::SetNextWindowSize(size);
  ImGui::SetNextWindowBgAlpha(0.0f);
  ImGui::Begin(name, nullptr, fixed | flags);
  draw();
  ImGui::End();
}

/// Draws the message. An announcement stays until it is clicked, which shows the last frame before failure.
void draw_message(Gui& gui) {
  if (!gui.state.announcement.empty()) {
    ImGui::PushStyleColor(ImGuiCol_Button, packed(gui.colours.alarm));
    ImGui::PushStyleColor(ImGuiCol_ButtonHovered, packed(gui.colours.alarm));
    ImGui::PushStyleColor(ImGuiCol_Text, packed(gui.colours.alarm_text));
    if (named_button(gui, "announcement", gui.state.announcement.c_str(),
                     "click: the last frame before it")) {
      gui.model.go_to(view::Landmark::theta_c);
      gui.state.announcement.clear();
    }
    ImGui::PopStyleColor(3);
    ImGui::SameLine();
  }
  if (gui.state.message.empty())
    ImGui::TextDisabled("? lists the keys");
  else
    ImGui::TextUnformatted(gui.state.message.c_str());
}

/// Draws the column of foldable groups. The first selection unfolds the inspector; later ones move nothing.
void draw_column(Gui& gui) {
  ImGui::BeginChild("column");
  const bool several = ImGui::GetWindowHeight() >= room_for_several * gui.em;
  const bool selected = gui.state.selected || gui.state.selecting.selection.contact;
  if (selected && gui.panel_asked.empty() && !std::exchange(gui.state.inspected, true))
    gui.panel_asked = group_of_key('G');
  for (const Group& group : groups) draw_group(gui, group, several);
  ImGui::EndChild();
}

}  // namespace

const char* group_of_key(ImWchar key) {
  const auto* const found =
      std::ranges::find(groups, key, [](const Group& group) { return static_cast<ImWchar>(group.key); });
  return found == std::end(groups) ? "" : found->name;
}

void draw_gui(view::ViewModel& model, const DrawMap& draw_map, std::vector<WidgetPlace>& places,
              GuiRequests& requests) {
  Gui gui{model,
          model.state,
          draw_map,
          places,
          requests,
          palette_of(model.state.theme),
          ImGui::GetFontSize(),
          std::exchange(model.state.panel_asked, {})};
  offer_tilt_ahead(model);
  handle_keys(gui);
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const float line = 1.9f * gui.em;  // height of the message line
  const float time_line = size.y >= 30.0f * gui.em ? 3.9f * gui.em : 0.0f;
  const float height = size.y - line - time_line;
  const float left = model.state.show_controls ? std::min(19.0f * gui.em, 0.5f * size.x) : 0.0f;
  const float right = size.x - left, bottom = height_of_plots(model, right, height, gui.em);
  part("controls", {0.0f, 0.0f}, {left, height}, 0, [&] { draw_column(gui); });
  part("picture", {left, 0.0f}, {right, height - bottom}, ImGuiWindowFlags_NoScrollWithMouse,
       [&] { draw_map_area(gui); });
  part("plots", {left, height - bottom}, {right, bottom}, 0, [&] {
    draw_border(gui, 0.0f, height);
    ImGui::BeginChild("curves");
    draw_plots(gui);
    ImGui::EndChild();
  });
  part("time line", {0.0f, height}, {size.x, time_line}, 0, [&] { draw_time_line(gui); });
  part("message", {0.0f, height + time_line}, {size.x, line}, 0, [&] { draw_message(gui); });
  if (model.state.show_help) draw_help(gui);
}

}  // namespace talus::gui
