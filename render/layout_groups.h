#pragma once
/// The parts of the furniture, each laid out at (0, 0).

#include <string>
#include <vector>

#include "render/layout.h"

namespace talus::render {

// Lengths in units of the font size.
inline constexpr double line_height = text_ascent + text_descent;
inline constexpr double gap_between_groups = 2.0;

struct Group {
  double width = 0.0, height = 0.0;
  std::vector<PlacedText> texts;
  std::vector<PlacedBar> bars;
  std::vector<PlacedSwatch> swatches;
  Box scale_bar;
  Box arrow;
};

// `room` is the available width, px, for groups whose lines can be broken.

/// Lays out a text; broken lines are aligned at the right if `right_aligned`.
Group text_group(const std::string& text, double room, double em, const Font& font,
                 bool right_aligned = false);
/// Lays out a right-aligned text followed by a small gravity arrow.
Group text_with_arrow_group(const std::string& text, double room, double em, const Font& font);
/// Lays out a bar with its title on the left, or above if there is no room for both, and its ticks below.
Group bar_group(const Bar& bar, double room, double em, const Font& font);
Group swatch_group(const Swatch& swatch, double room, double em, const Font& font);
/// Lays out the scale bar with its label below, and the gravity arrow with its label.
Group scale_group(const FrameView& view, double scale, double em, const Font& font);

/// Places a text with its upper left corner at (x, y).
PlacedText place_text(const std::string& text, double x, double y, double em, const Font& font);

/// Adds a group to a picture with its upper left corner at (x, y).
void add_group(Layout& layout, const Group& group, double x, double y);

}  // namespace talus::render
