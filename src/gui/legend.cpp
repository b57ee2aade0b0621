#include <algorithm>
#include <fmt/core.h>
#include <string>
#include <utility>
#include <vector>

#include "gui/panels.h"

namespace talus::gui {
namespace {

// Lengths in em.
constexpr float bar_length = 12.0f, shortest_bar = 5.0f, text_line = 1.2f;
constexpr float below_bar = 2.4f;  ///< distance from its top to the lower edge of its labels, with some space
constexpr float swatch_text = 1.9f, after_text = 1.0f;

/// Bar or swatch with its place, px from the corner of the legend.
struct LegendItem {
  const render::Bar* bar = nullptr;
  const render::Swatch* swatch = nullptr;
  std::vector<std::string> lines;  ///< lines of its title or its label
  float x = 0.0f, y = 0.0f, width = 0.0f, height = 0.0f;
  float bar_left = 0.0f, bar_top = 0.0f, bar_length = 0.0f;
};

/// Returns by how much the first label of a bar extends to its left, or the last one to its right.
float half_label(const render::Bar& bar, bool first, float em) {
  if (bar.ticks.empty()) return 0.0f;
  const render::BarTick& tick = first ? bar.ticks.front() : bar.ticks.back();
  const float out = static_cast<float>(first ? tick.share : 1.0 - tick.share) * bar_length * em;
  return std::max(0.0f, 0.5f * rich_width(tick.label) - out);
}

/// Lays out a bar next to its title, or below it if there is no room for both.
LegendItem bar_item(const render::Bar& bar, float room, float em) {
  LegendItem item;
  item.bar = &bar;
  const float low = half_label(bar, true, em), high = half_label(bar, false, em);
  const float title = rich_width(bar.title) + 0.8f * em;
  item.bar_length = bar_length * em;
  item.bar_left = std::max(title, low);
  item.lines = {bar.title};
  if (item.bar_left + item.bar_length + high > room) {
    item.lines = wrapped_text(bar.title, room);
    item.bar_left = low;
    item.bar_top = static_cast<float>(item.lines.size()) * text_line * em;
    item.bar_length = std::max(shortest_bar * em, std::min(item.bar_length, room - low - high));
  }
  item.width = item.bar_left + item.bar_length + high;
  for (const std::string& line : item.lines) item.width = std::max(item.width, rich_width(line));
  item.height = item.bar_top + below_bar * em;
  return item;
}

LegendItem swatch_item(const render::Swatch& swatch, float room, float em) {
  LegendItem item;
  item.swatch = &swatch;
  item.lines = wrapped_text(swatch.label, room - swatch_text * em);
  for (const std::string& line : item.lines)
    item.width = std::max(item.width, swatch_text * em + rich_width(line));
  item.height = static_cast<float>(item.lines.size()) * text_line * em;
  return item;
}

/// Lays out the items of a legend in rows; returns its height, px.
float lay_out_legend(const render::FrameView& view, float room, float em, std::vector<LegendItem>& items) {
  for (const render::Legend& legend : view.legends) {
    for (const render::Bar& bar : legend.bars) items.push_back(bar_item(bar, room, em));
    for (const render::Swatch& swatch : legend.swatches) items.push_back(swatch_item(swatch, room, em));
  }
  float x = 0.0f, y = 0.0f, bottom = 0.0f;
  for (LegendItem& item : items) {
    if (x > 0.0f && x + item.width > room) {
      x = 0.0f;
      y = bottom;
    }
    item.x = x;
    item.y = y;
    x += item.width + after_text * em;
    bottom = std::max(bottom, y + item.height);
  }
  return bottom;
}

/// Handles the mouse on a bar: dragging its ends sets the range of the map, a double click restores it.
void use_bar(Gui& gui, const render::Bar& bar, const ImVec2& low, const ImVec2& high) {
  const float em = gui.em, length = high.x - low.x;
  pictures::MapSettings& map = gui.state.map;
  ImGui::SetCursorScreenPos({low.x - 0.5f * em, low.y});
  ImGui::InvisibleButton("range of the bar", {length + em, high.y - low.y});
  note_place(gui, "legend bar", low, high);
  const float x = ImGui::GetIO().MousePos.x;
  using Part = view::HeldBar::Part;
  const Part part = x < low.x + 0.6f * em ? Part::low : x > high.x - 0.6f * em ? Part::high : Part::middle;
  const view::BarEnds ends{bar.low, bar.high, bar.logarithmic};
  view::HeldBar& held = gui.state.held_bar;
  if (ImGui::IsItemActivated()) held = {part, ends, static_cast<double>(x)};
  if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(0)) {
    map.range_low.reset();
    map.range_high.reset();
    held.part = Part::none;
  }
  if (!ImGui::IsItemActive()) held.part = Part::none;
  if (held.part != Part::none && ImGui::GetIO().MouseDelta.x != 0.0f) {
    const auto [from, to] =
        view::pulled(held, (static_cast<double>(x) - held.from) / static_cast<double>(length));
    map.range_low = from;
    map.range_high = to;
  }
  if (!ImGui::IsItemHovered() && !ImGui::IsItemActive()) return;
  ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  for (const float end : {low.x, high.x})
    list.AddRectFilled({end - 0.15f * em, low.y - 0.15f * em}, {end + 0.15f * em, high.y + 0.15f * em},
                       packed(gui.colours.accent), 0.15f * em);
  if (ImGui::IsItemActive()) return;
  const double share = std::clamp(static_cast<double>((x - low.x) / length), 0.0, 1.0);
  ImGui::BeginTooltip();
  rich_text(fmt::format("{} = {:.3g} {}", bar.symbol, view::value_at(ends, share), bar.unit));
  rich_text("drag an end or the middle; double click restores the range of the map");
  ImGui::EndTooltip();
}

void draw_bar(Gui& gui, const LegendItem& item, const ImVec2& corner, bool of_first) {
  const render::Bar& bar = *item.bar;
  const float em = gui.em, length = item.bar_length, height = 0.85f * em;
  const ImU32 ink = packed(gui.colours.ink);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  for (std::size_t k = 0; k < item.lines.size(); ++k)
    add_rich_text(list, {corner.x, corner.y - 0.1f * em + static_cast<float>(k) * text_line * em}, ink,
                  item.lines[k]);
  const float left = corner.x + item.bar_left, top = corner.y + item.bar_top;
  const std::size_t pieces = bar.colours.size() - 1;
  for (std::size_t k = 0; k < pieces; ++k) {
    const float x0 = left + length * static_cast<float>(k) / static_cast<float>(pieces);
    const float x1 = left + length * static_cast<float>(k + 1) / static_cast<float>(pieces);
    list.AddRectFilled({x0, top}, {x1, top + height}, packed(bar.colours[k]));
  }
  list.AddRect({left, top}, {left + length, top + height}, ink);
  float free_from = 0.0f;
  push_font(*ImGui::GetIO().Fonts->Fonts[1]);  // that of ticks
  for (const render::BarTick& tick : bar.ticks) {
    const float x = left + static_cast<float>(tick.share) * length;
    list.AddLine({x, top + height}, {x, top + height + 0.2f * em}, ink);
    const float label = rich_width(tick.label), at = x - 0.5f * label;
    if (at < free_from) continue;
    free_from = at + label + 0.4f * em;
    add_rich_text(list, {at, top + height + 0.25f * em}, ink, tick.label);
  }
  ImGui::PopFont();
  if (of_first) use_bar(gui, bar, {left, top}, {left + length, top + height});
}

void draw_swatch(Gui& gui, const LegendItem& item, const ImVec2& corner) {
  const render::Swatch& swatch = *item.swatch;
  const float em = gui.em, middle = corner.y + 0.55f * em;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (swatch.kind == render::Swatch::Kind::line) {
    list.AddLine({corner.x, middle}, {corner.x + 1.6f * em, middle}, packed(swatch.fill),
                 std::max(1.0f, static_cast<float>(swatch.width) * em));
  } else {
    list.AddCircleFilled({corner.x + 1.0f * em, middle}, 0.45f * em, packed(swatch.rim));
    list.AddCircleFilled({corner.x + 1.0f * em, middle}, 0.36f * em, packed(swatch.fill));
  }
  for (std::size_t k = 0; k < item.lines.size(); ++k)
    add_rich_text(list, {corner.x + swatch_text * em, corner.y + static_cast<float>(k) * text_line * em},
                  packed(gui.colours.ink), item.lines[k]);
  note_place(gui, "swatch " + swatch.label, corner, {corner.x + item.width, corner.y + item.height});
}

}  // namespace

float legend_height(const render::FrameView& view, float width) {
  std::vector<LegendItem> items;
  return lay_out_legend(view, width, ImGui::GetFontSize(), items);
}

void draw_legends(Gui& gui, const render::FrameView& view, float width, bool of_first) {
  std::vector<LegendItem> items;
  const float height = lay_out_legend(view, width, gui.em, items);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  bool first = of_first;  // bar whose range can be chosen
  for (const LegendItem& item : items) {
    const ImVec2 at{corner.x + item.x, corner.y + item.y};
    if (item.bar != nullptr)
      draw_bar(gui, item, at, std::exchange(first, false));
    else
      draw_swatch(gui, item, at);
  }
  ImGui::SetCursorScreenPos(corner);
  ImGui::Dummy({width, height});
}

}  // namespace talus::gui
