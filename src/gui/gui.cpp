#include "gui/gui.h"

#include <algorithm>

#include "gui/panels.h"

namespace talus {
namespace {

constexpr ImGuiWindowFlags fixed = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus;

/// Where the parts of the window are: from its size alone.
struct Places {
  float left = 0.0f;    ///< width of the panels on the left; 0: not shown
  float right = 0.0f;   ///< of the inspector
  float bottom = 0.0f;  ///< height of the plots
};

Places lay_out_window(const ViewState& state, const ImVec2& size, float em) {
  Places places;
  const bool wide = size.x >= 45.0f * em;
  if (state.show_controls) places.left = std::min(19.0f * em, 0.5f * size.x);
  if (state.show_inspector && state.selected && wide) places.right = std::min(20.0f * em, 0.3f * size.x);
  if (state.show_plots && size.y >= 32.0f * em) places.bottom = std::max(12.0f * em, 0.28f * size.y);
  return places;
}

/// A part of the window at a place.
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

void draw_tabs(Gui& gui, bool with_inspector) {
  if (!ImGui::BeginTabBar("panels")) return;
  const auto tab = [&](const char* name, void (*draw)(Gui&)) {
    const bool open = ImGui::BeginTabItem(name);
    note_place(gui, std::string("tab ").append(name));
    if (!open) return;
    ImGui::BeginChild("panel");
    draw(gui);
    ImGui::EndChild();
    ImGui::EndTabItem();
  };
  tab("run", draw_run_panel);
  tab("map", draw_map_panel);
  tab("act", draw_action_panel);
  tab("files", draw_file_panel);
  if (with_inspector) tab("grain", draw_inspector);
  ImGui::EndTabBar();
}

void draw_message(const ViewState& state) {
  if (state.message.empty())
    ImGui::TextDisabled("? lists the keys");
  else
    ImGui::TextUnformatted(state.message.c_str());
}

}  // namespace

GuiRequests draw_gui(ViewModel& model, const DrawMap& draw_map, std::vector<WidgetPlace>& places) {
  GuiRequests requests;
  Gui gui{model, draw_map, places, requests, ImGui::GetFontSize()};
  handle_keys(gui);
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const float line = 1.9f * gui.em;  // the message at the bottom
  const Places at = lay_out_window(model.state, size, gui.em);
  const float height = size.y - line, middle = size.x - at.left - at.right;
  part("controls", {0.0f, 0.0f}, {at.left, height}, 0, [&] { draw_tabs(gui, at.right == 0.0f); });
  part("grain", {size.x - at.right, 0.0f}, {at.right, height}, ImGuiWindowFlags_None, [&] {
    ImGui::BeginChild("inspector");
    draw_inspector(gui);
    ImGui::EndChild();
  });
  part("picture", {at.left, 0.0f}, {middle, height - at.bottom}, ImGuiWindowFlags_NoScrollWithMouse,
       [&] { draw_map_area(gui); });
  part("plots", {at.left, height - at.bottom}, {middle, at.bottom}, 0, [&] {
    ImGui::BeginChild("curves", {0.0f, 0.0f}, false, ImGuiWindowFlags_HorizontalScrollbar);
    draw_plots(gui);
    ImGui::EndChild();
  });
  part("message", {0.0f, height}, {size.x, line}, 0, [&] { draw_message(model.state); });
  if (model.state.show_help) draw_help(gui);
  return requests;
}

void set_style(float scale) {
  ImGui::StyleColorsLight();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowRounding = 0.0f;
  style.WindowBorderSize = 1.0f;
  style.FrameBorderSize = 1.0f;
  style.ScaleAllSizes(scale);
  style.Colors[ImGuiCol_WindowBg] = ImVec4(0.97f, 0.97f, 0.97f, 1.0f);
}

}  // namespace talus
