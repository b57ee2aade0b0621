#pragma once
/// The look of the window: all of its colours, sizes of text and distances. No other file of this folder has
/// a colour of its own.

#include <imgui.h>

#include <array>

#include "render/colour.h"
#include "view/theme.h"

namespace talus::gui {

/// What colours are for.
struct Palette {
  // Surfaces.
  render::Colour ground;   ///< of the map and the plots, and behind everything
  render::Colour panel;    ///< of the columns beside them
  render::Colour raised;   ///< buttons, headings of sections
  render::Colour hovered;  ///< the same under the mouse
  render::Colour pressed;  ///< the same while it is held, and what is chosen of a few
  render::Colour field;    ///< what can be typed into, or slid along
  render::Colour tint;     ///< chosen rows; the part of the time line that has passed
  render::Colour track;    ///< the part that is to come
  render::Colour range;    ///< a range that is chosen; lets through what is below it
  render::Colour note;     ///< behind text over curves

  // Lines and texts.
  render::Colour line;         ///< borders
  render::Colour ink;          ///< text and axes
  render::Colour soft;         ///< text that explains
  render::Colour accent;       ///< the frame shown, check marks
  render::Colour alarm;        ///< a run that has failed: a field with alarm_text
  render::Colour alarm_text;   ///< on it
  render::Colour warning;      ///< what went wrong, as text
  render::Colour grid;         ///< theta_c in plots, dashed
  render::Colour frame_shown;  ///< the line of the frame shown, in plots

  // Events of the time line, also as text.
  render::Colour transition, failure, command, rearrangement, bookmark;

  std::array<render::Colour, 4> curves;  ///< in their order; they differ in lightness
};

const Palette& palette_of(view::Theme theme);

/// A colour for Dear ImGui.
inline ImU32 packed(const render::Colour& colour) {
  return IM_COL32(colour.red, colour.green, colour.blue, colour.alpha);
}
inline ImVec4 mixed(const render::Colour& colour) { return ImGui::ColorConvertU32ToFloat4(packed(colour)); }

/// Heights of text on a display of scale 1, px, in the order of TextSize: of text, of ticks and hints, and of
/// what a part of the window is about.
inline constexpr std::array<float, 3> type_scale = {15.0f, 12.5f, 17.0f};

/// The style of a theme, on a display of that scale.
ImGuiStyle style_of(view::Theme theme, float scale);

}  // namespace talus::gui
