#include <algorithm>

#include "gui/panels.h"

namespace talus {
namespace {

/// Goes to the next line if what follows would not fit.
void make_room(float width) {
  if (ImGui::GetCursorPosX() > ImGui::GetStyle().WindowPadding.x + 1.0f &&
      ImGui::GetContentRegionAvail().x < width)
    ImGui::NewLine();
}

void draw_bar(const Bar& bar, float em, ImU32 ink) {
  const ImFont& font = *ImGui::GetFont();
  const float size = ImGui::GetFontSize(), title = rich_width(font, size, bar.title);
  float length = 12.0f * em;
  const float width = title + 0.6f * em + length + 4.0f * em;
  make_room(width);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  add_rich_text(list, corner, ink, bar.title);
  const float left = corner.x + title + 0.6f * em;
  const std::size_t pieces = bar.colours.size() - 1;
  for (std::size_t k = 0; k < pieces; ++k) {
    const float x0 = left + length * static_cast<float>(k) / static_cast<float>(pieces);
    const float x1 = left + length * static_cast<float>(k + 1) / static_cast<float>(pieces);
    list.AddRectFilled({x0, corner.y}, {x1, corner.y + em}, packed(bar.colours[k]));
  }
  list.AddRect({left, corner.y}, {left + length, corner.y + em}, ink);
  float free_from = 0.0f;
  for (const BarTick& tick : bar.ticks) {
    const float x = left + static_cast<float>(tick.share) * length;
    list.AddLine({x, corner.y + em}, {x, corner.y + 1.2f * em}, ink);
    const float label = rich_width(font, size, tick.label), at = x - 0.5f * label;
    if (at < free_from) continue;
    free_from = at + label + 0.4f * em;
    add_rich_text(list, {at, corner.y + 1.2f * em}, ink, tick.label);
  }
  ImGui::Dummy({width, 2.4f * em});
  ImGui::SameLine();
}

void draw_swatch(const Swatch& swatch, float em, ImU32 ink) {
  const float label = rich_width(*ImGui::GetFont(), ImGui::GetFontSize(), swatch.label);
  make_room(2.4f * em + label);
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
  ImGui::Dummy({2.4f * em + label, 2.4f * em});
  ImGui::SameLine();
}

}  // namespace

void draw_legends(Gui& gui, const FrameView& view) {
  const float em = gui.em;
  const ImU32 ink = packed(gui.colours.ink);
  for (const Legend& legend : view.legends) {
    for (const Bar& bar : legend.bars) draw_bar(bar, em, ink);
    for (const Swatch& swatch : legend.swatches) draw_swatch(swatch, em, ink);
  }
  ImGui::NewLine();
}

}  // namespace talus
