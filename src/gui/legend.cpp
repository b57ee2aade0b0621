#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <utility>

#include "gui/panels.h"

namespace talus {
namespace {

/// Goes to the next line if what follows would not fit beside what is left free on the right.
void make_room(float width, float margin) {
  if (ImGui::GetCursorPosX() > ImGui::GetStyle().WindowPadding.x + 1.0f &&
      ImGui::GetContentRegionAvail().x - margin < width)
    ImGui::NewLine();
}

float text_width(const std::string& text) {
  return rich_width(*ImGui::GetFont(), ImGui::GetFontSize(), text);
}

constexpr float bar_length = 12.0f;  // em

float width_of(const Bar& bar, float em) { return text_width(bar.title) + (0.6f + bar_length + 4.0f) * em; }

float width_of(const Swatch& swatch, float em) { return 2.4f * em + text_width(swatch.label); }

/// The mouse on a bar: pulling its ends sets the range of the map, a double click gives back the map's own.
void use_bar(Gui& gui, const Bar& bar, const ImVec2& low, const ImVec2& high) {
  const float em = gui.em, length = high.x - low.x;
  MapSettings& map = gui.model.state.map;
  ImGui::SetCursorScreenPos({low.x - 0.5f * em, low.y});
  ImGui::InvisibleButton("range of the bar", {length + em, high.y - low.y});
  note_place(gui, "legend bar", low, high);
  const float x = ImGui::GetIO().MousePos.x;
  using Part = HeldBar::Part;
  const Part part = x < low.x + 0.6f * em ? Part::low : x > high.x - 0.6f * em ? Part::high : Part::middle;
  const BarEnds ends{bar.low, bar.high, bar.logarithmic};
  HeldBar& held = gui.model.state.held_bar;
  if (ImGui::IsItemActivated()) held = {part, ends, static_cast<double>(x)};
  if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(0)) {
    map.range_low.reset();
    map.range_high.reset();
    held.part = Part::none;
  }
  if (!ImGui::IsItemActive()) held.part = Part::none;
  if (held.part != Part::none && ImGui::GetIO().MouseDelta.x != 0.0f) {
    const auto [from, to] = pulled(held, (static_cast<double>(x) - held.from) / static_cast<double>(length));
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
  rich_text(fmt::format("{} = {:.3g} {}", bar.symbol, value_at(ends, share), bar.unit));
  rich_text("drag an end, or the middle; double click: the range of the map");
  ImGui::EndTooltip();
}

/// Where a bar lies that has been drawn.
struct DrawnBar {
  ImVec2 low, high;
};

DrawnBar draw_bar(const Bar& bar, float em, ImU32 ink, float margin) {
  const float title = text_width(bar.title), length = bar_length * em, height = 0.85f * em;
  const float width = width_of(bar, em);
  make_room(width, margin);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  add_rich_text(list, {corner.x, corner.y - 0.1f * em}, ink, bar.title);
  const float left = corner.x + title + 0.8f * em;
  const std::size_t pieces = bar.colours.size() - 1;
  for (std::size_t k = 0; k < pieces; ++k) {
    const float x0 = left + length * static_cast<float>(k) / static_cast<float>(pieces);
    const float x1 = left + length * static_cast<float>(k + 1) / static_cast<float>(pieces);
    list.AddRectFilled({x0, corner.y}, {x1, corner.y + height}, packed(bar.colours[k]));
  }
  list.AddRect({left, corner.y}, {left + length, corner.y + height}, ink);
  float free_from = 0.0f;
  const TextOfSize small(TextSize::small);
  for (const BarTick& tick : bar.ticks) {
    const float x = left + static_cast<float>(tick.share) * length;
    list.AddLine({x, corner.y + height}, {x, corner.y + height + 0.2f * em}, ink);
    const float label = rich_width(*ImGui::GetFont(), ImGui::GetFontSize(), tick.label),
                at = x - 0.5f * label;
    if (at < free_from) continue;
    free_from = at + label + 0.4f * em;
    add_rich_text(list, {at, corner.y + height + 0.25f * em}, ink, tick.label);
  }
  ImGui::Dummy({width, 2.4f * em});
  return {{left, corner.y}, {left + length, corner.y + height}};
}

void draw_swatch(Gui& gui, const Swatch& swatch, float margin) {
  const float em = gui.em;
  const ImU32 ink = packed(gui.colours.ink);
  const float width = width_of(swatch, em);
  make_room(width, margin);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float middle = corner.y + 0.55f * em;
  if (swatch.kind == Swatch::Kind::line) {
    list.AddLine({corner.x, middle}, {corner.x + 1.6f * em, middle}, packed(swatch.fill),
                 std::max(1.0f, static_cast<float>(swatch.width) * em));
  } else {
    list.AddCircleFilled({corner.x + 1.0f * em, middle}, 0.45f * em, packed(swatch.rim));
    list.AddCircleFilled({corner.x + 1.0f * em, middle}, 0.36f * em, packed(swatch.fill));
  }
  add_rich_text(list, {corner.x + 1.9f * em, corner.y}, ink, swatch.label);
  ImGui::Dummy({width, 1.1f * em});  // two lines of swatches are as high as one of bars
  note_place(gui, "swatch " + swatch.label);
  ImGui::SameLine();
}

}  // namespace

int legend_rows(const FrameView& view, float width) {
  const float em = ImGui::GetFontSize(), between = ImGui::GetStyle().ItemSpacing.x;
  int rows = 1;
  float taken = 0.0f;
  const auto place = [&](float next) {
    if (taken > 0.0f && taken + next > width) {
      ++rows;
      taken = 0.0f;
    }
    taken += next + between;
  };
  for (const Legend& legend : view.legends) {
    for (const Bar& bar : legend.bars) place(width_of(bar, em));
    for (const Swatch& swatch : legend.swatches) place(width_of(swatch, em));
  }
  return rows;
}

void draw_legends(Gui& gui, const FrameView& view, bool of_first, float margin) {
  const float em = gui.em;
  const ImU32 ink = packed(gui.colours.ink);
  bool first = of_first;  // the bar whose range can be chosen
  for (const Legend& legend : view.legends) {
    for (const Bar& bar : legend.bars) {
      const DrawnBar drawn = draw_bar(bar, em, ink, margin);
      ImGui::SameLine();
      const ImVec2 next = ImGui::GetCursorScreenPos();
      if (std::exchange(first, false)) {
        use_bar(gui, bar, drawn.low, drawn.high);
        ImGui::SetCursorScreenPos(next);
      }
    }
    for (const Swatch& swatch : legend.swatches) draw_swatch(gui, swatch, margin);
  }
  ImGui::NewLine();
}

}  // namespace talus
