#pragma once
/// The look of the window: all of its colours, sizes of text and distances. No other file of this folder has
/// a colour of its own.

#include <imgui.h>

#include <array>

#include "render/colour.h"
#include "view/theme.h"

namespace talus {

/// What colours are for.
struct Palette {
  // Surfaces.
  Colour ground;   ///< of the map and the plots, and behind everything
  Colour panel;    ///< of the columns beside them
  Colour raised;   ///< buttons, headings of sections
  Colour hovered;  ///< the same under the mouse
  Colour pressed;  ///< the same while it is held, and what is chosen of a few
  Colour field;    ///< what can be typed into, or slid along
  Colour tint;     ///< chosen rows; the part of the time line that has passed
  Colour track;    ///< the part that is to come
  Colour range;    ///< a range that is chosen; lets through what is below it
  Colour note;     ///< behind text over curves

  // Lines and texts.
  Colour line;         ///< borders
  Colour ink;          ///< text and axes
  Colour soft;         ///< text that explains
  Colour accent;       ///< the frame shown, check marks
  Colour alarm;        ///< a run that has failed: a field with alarm_text
  Colour alarm_text;   ///< on it
  Colour warning;      ///< what went wrong, as text
  Colour grid;         ///< theta_c in plots, dashed
  Colour frame_shown;  ///< the line of the frame shown, in plots

  // Events of the time line, also as text.
  Colour transition, failure, command, rearrangement, bookmark;

  std::array<Colour, 4> curves;  ///< in their order; they differ in lightness
};

const Palette& palette_of(Theme theme);

/// A colour for Dear ImGui.
inline ImU32 packed(const Colour& colour) {
  return IM_COL32(colour.red, colour.green, colour.blue, colour.alpha);
}
inline ImVec4 mixed(const Colour& colour) { return ImGui::ColorConvertU32ToFloat4(packed(colour)); }

/// Heights of text on a display of scale 1, px, in the order of TextSize: of text, of ticks and hints, and of
/// what a part of the window is about.
inline constexpr std::array<float, 3> type_scale = {15.0f, 12.5f, 17.0f};

/// The style of a theme, on a display of that scale.
ImGuiStyle style_of(Theme theme, float scale);

}  // namespace talus
