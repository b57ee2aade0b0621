/// Two views of the bed.

#include <algorithm>
#include <array>
#include <filesystem>
#include <fmt/core.h>
#include <vector>

#include "gui/panels.h"

namespace talus {
namespace {

constexpr float gap = 0.8f;           ///< between the two, em
constexpr float legend_row = 2.4f;    ///< below each, em
constexpr float least_width = 12.0f;  ///< of a picture, em
constexpr float least_height = 3.0f;
constexpr int most_lines = 3;  ///< of the title of a map

/// What stands above a view.
struct PaneHead {
  std::string run;                 ///< "seed-1.h5"
  std::string caption;             ///< its angle
  std::vector<std::string> title;  ///< of its map, by lines
};

/// By words, in lines of that width; what is too much ends in "...".
std::vector<std::string> wrapped(const std::string& text, float width) {
  const ImFont& font = *ImGui::GetFont();
  const float size = ImGui::GetFontSize();
  std::vector<std::string> lines{""};
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find(' ', start), text.size());
    const std::string word = text.substr(start, end - start);
    const std::string longer = lines.back().empty() ? word : lines.back() + " " + word;
    if (lines.back().empty() || rich_width(font, size, longer) <= width)
      lines.back() = longer;
    else
      lines.push_back(word);
    start = end + 1;
  }
  if (lines.size() > most_lines) {
    lines.resize(most_lines);
    lines.back() += " …";
  }
  return lines;
}

PaneHead head_of(const ViewModel& of, const FrameView& annotated, float width) {
  return {std::filesystem::path(of.path()).filename().string(), annotated.caption,
          wrapped(annotated.title, width)};
}

/// Name and angle share a line where both have room.
int lines_of(const PaneHead& head, float width) {
  const ImFont& font = *ImGui::GetFont();
  const float size = ImGui::GetFontSize();
  const bool both = rich_width(font, size, head.run) + rich_width(font, size, head.caption) + size < width;
  return static_cast<int>(head.title.size()) + (both ? 1 : 2);
}

void draw_head(const PaneHead& head, float width, int lines) {
  const ImFont& font = *ImGui::GetFont();
  const float size = ImGui::GetFontSize(), line = 1.2f * size;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImU32 ink = ImGui::GetColorU32(ImGuiCol_Text);
  list.PushClipRect(corner, {corner.x + width, corner.y + static_cast<float>(lines) * line}, true);
  const bool one_line = lines_of(head, width) == static_cast<int>(head.title.size()) + 1;
  list.AddText(corner, ImGui::GetColorU32(ImGuiCol_CheckMark), head.run.c_str());
  const float right = corner.x + width - rich_width(font, size, head.caption);
  add_rich_text(list, {one_line ? right : corner.x, one_line ? corner.y : corner.y + line}, ink,
                head.caption);
  float y = corner.y + (one_line ? line : 2.0f * line);
  for (const std::string& text : head.title) {
    add_rich_text(list, {corner.x, y}, ink, text);
    y += line;
  }
  list.PopClipRect();
  ImGui::Dummy({width, static_cast<float>(lines) * line});
}

/// Where the two views are: as columns, or one above the other.
struct PairLayout {
  bool columns = true;
  ImVec2 pane;     ///< each, with what is above and below its picture
  ImVec2 picture;  ///< room for it
  int lines = 2;   ///< above it
  int rows = 1;    ///< of the legend below it
  std::array<PaneHead, 2> heads;
};

PairLayout pair_layout(const Gui& gui, const ImVec2& room, bool columns) {
  const float em = gui.em;
  PairLayout of;
  of.columns = columns;
  of.pane = columns ? ImVec2{0.5f * (room.x - gap * em), room.y} : ImVec2{room.x, 0.5f * (room.y - gap * em)};
  const ViewModel& model = gui.model;
  of.heads[0] = head_of(model, model.annotated_map(), of.pane.x);
  of.heads[1] =
      head_of(model.run_beside() ? *model.run_beside() : model, model.annotated_map_beside(), of.pane.x);
  of.lines = std::max(lines_of(of.heads[0], of.pane.x), lines_of(of.heads[1], of.pane.x));
  of.rows = std::max(legend_rows(model.annotated_map(), of.pane.x),
                     legend_rows(model.annotated_map_beside(), of.pane.x));
  const float between = ImGui::GetStyle().ItemSpacing.y;
  const float below = static_cast<float>(of.rows) * (legend_row * em + between);
  of.picture = {of.pane.x, of.pane.y - below - 1.2f * static_cast<float>(of.lines) * em - 2.0f * between};
  return of;
}

/// px of the picture that the bed fills; 0 where there is no room.
float bed_width(const PairLayout& of, double aspect, float em) {
  if (of.picture.x < least_width * em || of.picture.y < least_height * em) return 0.0f;
  return std::min(of.picture.x, of.picture.y * static_cast<float>(aspect));
}

}  // namespace

bool draw_pair(Gui& gui) {
  static constexpr const char* no_room =
      "There is no room for two views: make the window larger, or hide panels (h, l).";
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const double aspect = gui.model.bed_aspect();
  const PairLayout columns = pair_layout(gui, room, true), rows = pair_layout(gui, room, false);
  const float by_columns = bed_width(columns, aspect, gui.em), by_rows = bed_width(rows, aspect, gui.em);
  std::string& message = gui.model.state.message;
  if (by_columns == 0.0f && by_rows == 0.0f) {
    message = no_room;
    return false;
  }
  if (message == no_room) message.clear();
  const PairLayout& of = by_columns >= by_rows ? columns : rows;
  for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
    if (k == 1 && of.columns) ImGui::SameLine(0.0f, gap * gui.em);
    ImGui::BeginChild(k == 0 ? "first view" : "second view", of.pane, false,
                      ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    draw_head(of.heads[k], of.pane.x, of.lines);
    draw_map_pane(gui, {.beside = k == 1, .gravity = false}, of.picture);
    draw_legends(gui, k == 0 ? gui.model.annotated_map() : gui.model.annotated_map_beside(), k == 0);
    ImGui::EndChild();
  }
  return true;
}

}  // namespace talus
