#include <algorithm>

#include "gui/panels.h"

namespace talus {
namespace {

constexpr ImU32 legend_ink = IM_COL32(0, 0, 0, 255);

ImU32 colour_of(const Colour& colour) {
  return IM_COL32(colour.red, colour.green, colour.blue, colour.alpha);
}

/// Goes to the next line if what follows would not fit.
void make_room(float width) {
  if (ImGui::GetCursorPosX() > ImGui::GetStyle().WindowPadding.x + 1.0f &&
      ImGui::GetContentRegionAvail().x < width)
    ImGui::NewLine();
}

float text_width(const std::string& text) {
  return rich_width(*ImGui::GetFont(), ImGui::GetFontSize(), text);
}

constexpr float bar_length = 12.0f;  // em

float width_of(const Bar& bar, float em) { return text_width(bar.title) + (0.6f + bar_length + 4.0f) * em; }

float width_of(const Swatch& swatch, float em) { return 2.4f * em + text_width(swatch.label); }

void draw_bar(const Bar& bar, float em) {
  const ImFont& font = *ImGui::GetFont();
  const float size = ImGui::GetFontSize(), title = text_width(bar.title), length = bar_length * em;
  const float width = width_of(bar, em);
  make_room(width);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  add_rich_text(list, corner, legend_ink, bar.title);
  const float left = corner.x + title + 0.6f * em;
  const std::size_t pieces = bar.colours.size() - 1;
  for (std::size_t k = 0; k < pieces; ++k) {
    const float x0 = left + length * static_cast<float>(k) / static_cast<float>(pieces);
    const float x1 = left + length * static_cast<float>(k + 1) / static_cast<float>(pieces);
    list.AddRectFilled({x0, corner.y}, {x1, corner.y + em}, colour_of(bar.colours[k]));
  }
  list.AddRect({left, corner.y}, {left + length, corner.y + em}, legend_ink);
  float free_from = 0.0f;
  for (const BarTick& tick : bar.ticks) {
    const float x = left + static_cast<float>(tick.share) * length;
    list.AddLine({x, corner.y + em}, {x, corner.y + 1.2f * em}, legend_ink);
    const float label = rich_width(font, size, tick.label), at = x - 0.5f * label;
    if (at < free_from) continue;
    free_from = at + label + 0.4f * em;
    add_rich_text(list, {at, corner.y + 1.2f * em}, legend_ink, tick.label);
  }
  ImGui::Dummy({width, 2.4f * em});
  ImGui::SameLine();
}

void draw_swatch(const Swatch& swatch, float em) {
  const float width = width_of(swatch, em);
  make_room(width);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float middle = corner.y + 0.55f * em;
  if (swatch.kind == Swatch::Kind::line) {
    list.AddLine({corner.x, middle}, {corner.x + 1.6f * em, middle}, colour_of(swatch.fill),
                 std::max(1.0f, static_cast<float>(swatch.width) * em));
  } else {
    list.AddCircleFilled({corner.x + 1.0f * em, middle}, 0.45f * em, colour_of(swatch.rim));
    list.AddCircleFilled({corner.x + 1.0f * em, middle}, 0.36f * em, colour_of(swatch.fill));
  }
  add_rich_text(list, {corner.x + 1.9f * em, corner.y}, legend_ink, swatch.label);
  ImGui::Dummy({width, 2.4f * em});
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

void draw_legends(const FrameView& view) {
  const float em = ImGui::GetFontSize();
  for (const Legend& legend : view.legends) {
    for (const Bar& bar : legend.bars) draw_bar(bar, em);
    for (const Swatch& swatch : legend.swatches) draw_swatch(swatch, em);
  }
  ImGui::NewLine();
}

}  // namespace talus
