#pragma once
/// Appearance of the window: all colours, text sizes, distances and the font.

#include <imgui.h>

#include <array>

#include "render/colour.h"
#include "view/view_state.h"

namespace talus::gui {

/// Colours by purpose.
struct Palette {
  // Surfaces.
  render::Colour ground;   ///< map, plots, and background
  render::Colour panel;    ///< the column next to them
  render::Colour raised;   ///< buttons, headings of sections
  render::Colour hovered;  ///< a raised element under the mouse
  render::Colour pressed;  ///< a pressed element, and the chosen one of several
  render::Colour tint;     ///< chosen rows; the elapsed part of the time line
  render::Colour track;    ///< the remaining part of the time line
  render::Colour range;    ///< chosen range; transparent
  render::Colour note;     ///< background of text over curves

  // Lines and texts.
  render::Colour line;        ///< borders
  render::Colour ink;         ///< text and axes
  render::Colour soft;        ///< explanatory text
  render::Colour accent;      ///< frame shown, check marks
  render::Colour alarm;       ///< background of the report on a failed run
  render::Colour alarm_text;  ///< text on alarm
  render::Colour warning;     ///< error text
  render::Colour grid;        ///< theta_c in plots, dashed

  // Events of the time line, including their labels.
  render::Colour failure, command, rearrangement;

  std::array<render::Colour, 4> curves;  ///< used in this order; they differ in lightness
};

const Palette& palette_of(view::Theme theme);

/// Converts a colour for Dear ImGui.
inline ImU32 packed(const render::Colour& colour) {
  return IM_COL32(colour.red, colour.green, colour.blue, colour.alpha);
}

/// Text heights at display scale 1, px, in the order of the atlas's fonts: body text; ticks and hints;
/// headings of the parts of the window.
inline constexpr std::array<float, 3> type_scale = {15.0f, 12.5f, 17.0f};

/// Returns the style of a theme at that display scale.
ImGuiStyle style_of(view::Theme theme, float scale);

/// Adds the embedded font to an atlas in all sizes, each multiplied by `scale` and rounded to whole pixels,
/// and bakes them. It covers ASCII, Latin-1, Greek, super- and subscripts, arrows, mathematical signs and
/// simple shapes, which includes all characters of pictures.
void add_embedded_font(ImFontAtlas& atlas, float scale);

}  // namespace talus::gui
