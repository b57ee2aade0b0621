#include "gui/gui.h"

#include <algorithm>
#include <utility>

#include "gui/actions.h"
#include "gui/panels.h"

namespace talus::gui {
namespace {

constexpr ImGuiWindowFlags fixed = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus;

/// Sizes of the parts of the window.
struct Places {
  float left = 0.0f;    ///< width of the left column; 0: hidden
  float right = 0.0f;   ///< width of the inspector
  float bottom = 0.0f;  ///< height of the plots
};

/// Returns the height that the map does not need, or the height set by the user with the border between map
/// and plots; 0 if there is no room for both.
float height_of_plots(view::ViewModel& model, float width, float height, float em) {
  const float least = 12.0f * em;
  const auto map_height = [&](float picture) {
    return map_area_height(model.first().annotated_map(), width, picture, em);
  };
  const float min_map = std::max(least, map_height(4.0f * em));
  if (!model.state.show_plots || height < 1.1f * (min_map + least)) return 0.0f;
  const float wanted = model.state.picture_share > 0.0f
                           ? model.state.picture_share * height
                           : map_height(width / static_cast<float>(model.first().bed_aspect())) *
                                 (model.state.second_view.shown ? 2.1f : 1.0f);
  return height - std::clamp(wanted, min_map, height - least);
}

Places lay_out_window(view::ViewModel& model, const ImVec2& size, float em) {
  const view::ViewState& state = model.state;
  Places places;
  const bool wide = size.x >= 75.0f * em;
  if (state.show_controls) places.left = std::min(19.0f * em, 0.5f * size.x);
  if (state.show_inspector && wide) places.right = std::min(20.0f * em, 0.3f * size.x);
  places.bottom = height_of_plots(model, size.x - places.left - places.right, size.y, em);
  return places;
}

/// Draws the movable border between the map and the plots.
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
    gui.model.state.picture_share = std::clamp((ImGui::GetIO().MousePos.y - top) / height, 0.05f, 0.95f);
  if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(0)) gui.model.state.picture_share = 0.0f;
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
  view::ViewState& state = gui.model.state;
  if (!state.announcement.empty()) {
    ImGui::PushStyleColor(ImGuiCol_Button, packed(gui.colours.alarm));
    ImGui::PushStyleColor(ImGuiCol_ButtonHovered, packed(gui.colours.alarm));
    ImGui::PushStyleColor(ImGuiCol_Text, packed(gui.colours.alarm_text));
    if (named_button(gui, "announcement", state.announcement.c_str(), "click: the last frame before it")) {
      gui.model.go_to(view::Landmark::theta_c);
      state.announcement.clear();
    }
    ImGui::PopStyleColor(3);
    ImGui::SameLine();
  }
  if (state.message.empty())
    ImGui::TextDisabled("? lists the keys");
  else
    ImGui::TextUnformatted(state.message.c_str());
}

}  // namespace

GuiRequests draw_gui(view::ViewModel& model, const DrawMap& draw_map, std::vector<WidgetPlace>& places) {
  GuiRequests requests;
  Gui gui{model,
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
  const Places at = lay_out_window(model, {size.x, height}, gui.em);
  const float middle = size.x - at.left - at.right;
  part("controls", {0.0f, 0.0f}, {at.left, height}, 0, [&] { draw_column(gui, at.right == 0.0f); });
  part("grain", {size.x - at.right, 0.0f}, {at.right, height}, ImGuiWindowFlags_None, [&] {
    ImGui::BeginChild("inspector");
    draw_inspector(gui);
    ImGui::EndChild();
  });
  part("picture", {at.left, 0.0f}, {middle, height - at.bottom}, ImGuiWindowFlags_NoScrollWithMouse,
       [&] { draw_map_area(gui); });
  part("plots", {at.left, height - at.bottom}, {middle, at.bottom}, 0, [&] {
    draw_border(gui, 0.0f, height);
    ImGui::BeginChild("curves");
    draw_plots(gui);
    ImGui::EndChild();
  });
  part("time line", {0.0f, height}, {size.x, time_line}, 0, [&] { draw_time_line(gui); });
  part("message", {0.0f, height + time_line}, {size.x, line}, 0, [&] { draw_message(gui); });
  if (model.state.show_help) draw_help(gui);
  return requests;
}

}  // namespace talus::gui
