/// Two views of the bed.

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "gui/panels.h"

namespace talus::gui {
namespace {

constexpr float gap = 0.8f;         ///< gap between the two, em
constexpr float min_width = 12.0f;  ///< minimum width of a picture, em
constexpr float min_height = 3.0f;

/// Returns the lines above a view: its angle, and the title of its map.
std::vector<std::string> head_of(const view::View& pane, float width) {
  const render::FrameView& annotated = pane.annotated_map();
  std::vector<std::string> head = wrapped_text(annotated.caption, width);
  for (std::string& line : wrapped_text(annotated.title, width)) head.push_back(std::move(line));
  return head;
}

void draw_head(const std::vector<std::string>& head, float width, std::size_t lines) {
  const float line = 1.2f * ImGui::GetFontSize();
  ImVec2 corner = ImGui::GetCursorScreenPos();
  for (const std::string& text : head) {
    add_rich_text(*ImGui::GetWindowDrawList(), corner, ImGui::GetColorU32(ImGuiCol_Text), text);
    corner.y += line;
  }
  ImGui::Dummy({width, static_cast<float>(lines) * line});
}

/// Layout of the two views: side by side, or one above the other.
struct PairLayout {
  bool columns = true;
  ImVec2 pane;            ///< size of each view, including everything above and below its picture
  ImVec2 picture;         ///< room for the picture
  std::size_t lines = 0;  ///< number of lines above it
  float below = 0.0f;     ///< height of the legend below it
  std::array<std::vector<std::string>, 2> heads;
};

PairLayout pair_layout(const Gui& gui, const std::array<view::View, 2>& views, const ImVec2& room,
                       bool columns) {
  const float em = gui.em;
  PairLayout layout;
  layout.columns = columns;
  layout.pane =
      columns ? ImVec2{0.5f * (room.x - gap * em), room.y} : ImVec2{room.x, 0.5f * (room.y - gap * em)};
  for (std::size_t k = 0; k < views.size(); ++k) {
    layout.heads[k] = head_of(views[k], layout.pane.x);
    layout.lines = std::max(layout.lines, layout.heads[k].size());
    layout.below = std::max(layout.below, legend_height(views[k].annotated_map(), layout.pane.x));
  }
  const float between = ImGui::GetStyle().ItemSpacing.y;
  layout.picture = {layout.pane.x, layout.pane.y - layout.below -
                                       1.2f * static_cast<float>(layout.lines) * em - 3.0f * between};
  return layout;
}

/// Returns the width in px that the bed fills; 0 if there is no room.
float bed_width(const PairLayout& layout, double aspect, float em) {
  if (layout.picture.x < min_width * em || layout.picture.y < min_height * em) return 0.0f;
  return std::min(layout.picture.x, layout.picture.y * static_cast<float>(aspect));
}

}  // namespace

bool draw_pair(Gui& gui) {
  static constexpr const char* no_room =
      "There is no room for two views: make the window larger, or hide panels (h, l).";
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const std::array<view::View, 2> views = {gui.model.first(), gui.model.second()};
  const double aspect = views[0].bed_aspect();
  const PairLayout columns = pair_layout(gui, views, room, true), rows = pair_layout(gui, views, room, false);
  const float by_columns = bed_width(columns, aspect, gui.em), by_rows = bed_width(rows, aspect, gui.em);
  std::string& message = gui.model.state.message;
  if (by_columns == 0.0f && by_rows == 0.0f) {
    message = no_room;
    return false;
  }
  if (message == no_room) message.clear();
  const PairLayout& layout = by_columns >= by_rows ? columns : rows;
  for (std::size_t k = 0; k < views.size(); ++k) {
    if (k == 1 && layout.columns) ImGui::SameLine(0.0f, gap * gui.em);
    ImGui::BeginChild(k == 0 ? "first view" : "second view", layout.pane, false,
                      ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    draw_head(layout.heads[k], layout.pane.x, layout.lines);
    draw_map_pane(gui, views[k], layout.picture, false);
    draw_legends(gui, views[k].annotated_map(), layout.pane.x, k == 0);
    ImGui::EndChild();
  }
  return true;
}

}  // namespace talus::gui
