#pragma once
/// The look of the window: all of its colours, sizes of text and distances. No other file of this folder has
/// a colour of its own.

#include <imgui.h>

#include <array>
#include <span>
#include <string_view>

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

/// Text, and what it stands on.
struct TextPair {
  std::string_view name;
  Colour text, ground;
};
/// All pairs of text and ground that the window has in a theme.
std::array<TextPair, 19> text_pairs(const Palette& palette);

/// Contrast of two opaque colours, 1 ... 21 (WCAG 2.1, relative luminance).
double contrast(const Colour& a, const Colour& b);

/// Heights of text on a display of scale 1, px.
struct TypeScale {
  float body = 15.0f;
  float small = 12.5f;    ///< ticks, hints
  float heading = 17.0f;  ///< what a part of the window is about
};
inline constexpr TypeScale type_scale;

/// A distance to the side and one up and down.
struct Distance {
  float x = 0.0f, y = 0.0f;
};

/// Distances on a display of scale 1, px.
struct Spacing {
  Distance window{10.0f, 8.0f};  ///< between a part of the window and what is in it
  Distance frame{8.0f, 4.0f};    ///< between a widget and its text
  Distance item{8.0f, 6.0f};     ///< between widgets
  Distance inner{6.0f, 4.0f};    ///< between a widget and its label
  Distance cell{4.0f, 2.0f};     ///< of tables
  float rounding = 4.0f;
  float scroll_bar = 10.0f;
  float grab = 12.0f;
};
inline constexpr Spacing spacing;

/// The style of a theme, on a display of that scale.
ImGuiStyle style_of(Theme theme, float scale);

}  // namespace talus
