/// Two views of the bed.

#include <algorithm>
#include <array>
#include <filesystem>
#include <fmt/core.h>
#include <vector>

#include "gui/panels.h"

namespace talus::gui {
namespace {

constexpr float gap = 0.8f;         ///< gap between the two, em
constexpr float min_width = 12.0f;  ///< minimum width of a picture, em
constexpr float min_height = 3.0f;

/// Line above a view: the name of its run, its angle, or the title of its map.
struct HeadLine {
  std::string text;
  bool is_name = false;
  bool second_name = false;  ///< drawn on the right, in the line of the name
};
using PaneHead = std::vector<HeadLine>;

/// Shortens a name to a width (px) by leaving out its middle.
std::string shortened(const std::string& name, float width) {
  ImFont& font = *ImGui::GetFont();
  const float size = ImGui::GetFontSize();
  std::string shorter = name;
  for (std::size_t kept = name.size(); kept > 0 && rich_width(font, size, shorter) > width; --kept) {
    // Multi-byte characters must not be split.
    const auto begins = [&](std::size_t at) { return (static_cast<unsigned char>(name[at]) & 0xC0) != 0x80; };
    std::size_t head = kept / 2, tail = name.size() - (kept - head);
    while (head > 0 && !begins(head)) --head;
    while (tail < name.size() && !begins(tail)) ++tail;
    shorter = name.substr(0, head).append("…").append(name.substr(tail));
  }
  return shorter;
}

/// Lays out name and angle, in one line if both have room.
PaneHead head_of(const view::View& pane, float width) {
  const render::FrameView& annotated = pane.annotated_map();
  ImFont& font = *ImGui::GetFont();
  const float size = ImGui::GetFontSize();
  const std::string name = shortened(std::filesystem::path(pane.run.path()).filename().string(), width);
  const bool both =
      ImGui::CalcTextSize(name.c_str()).x + rich_width(font, size, annotated.caption) + size < width;
  PaneHead head = {{name, true, false}};
  for (const std::string& line : wrapped_text(annotated.caption, width)) head.push_back({line, false, both});
  for (const std::string& line : wrapped_text(annotated.title, width)) head.push_back({line, false, false});
  return head;
}

int lines_of(const PaneHead& head) {
  return static_cast<int>(std::ranges::count(head, false, &HeadLine::second_name));
}

void draw_head(const PaneHead& head, float width, int lines) {
  ImFont& font = *ImGui::GetFont();
  const float size = ImGui::GetFontSize(), line = 1.2f * size;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImU32 ink = ImGui::GetColorU32(ImGuiCol_Text);
  float y = corner.y;
  for (const HeadLine& entry : head) {
    if (entry.is_name)
      list.AddText({corner.x, y}, ImGui::GetColorU32(ImGuiCol_CheckMark), entry.text.c_str());
    else if (entry.second_name)
      add_rich_text(list, {corner.x + width - rich_width(font, size, entry.text), corner.y}, ink, entry.text);
    else
      add_rich_text(list, {corner.x, y}, ink, entry.text);
    if (!entry.second_name) y += line;
  }
  ImGui::Dummy({width, static_cast<float>(lines) * line});
}

/// Layout of the two views: side by side, or one above the other.
struct PairLayout {
  bool columns = true;
  ImVec2 pane;         ///< size of each view, including everything above and below its picture
  ImVec2 picture;      ///< room for the picture
  int lines = 0;       ///< number of lines above it
  float below = 0.0f;  ///< height of the legend below it
  std::array<PaneHead, 2> heads;
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
    layout.lines = std::max(layout.lines, lines_of(layout.heads[k]));
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
