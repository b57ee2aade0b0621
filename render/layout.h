#pragma once
/// Where everything goes: from a view and a width to rectangles in pixels. Pure: no picture is needed to test
/// it.

#include <string>
#include <vector>

#include "render/font.h"
#include "render/frame_view.h"

namespace talus {

/// A rectangle, px from the left and from the top of the picture.
struct Box {
  double x = 0.0, y = 0.0, width = 0.0, height = 0.0;
  double right() const { return x + width; }
  double bottom() const { return y + height; }
};

/// From metres in the frame of the bed to pixels: (origin_x + scale x, origin_y - scale y).
struct Camera {
  double scale = 0.0;     ///< px per m
  double origin_x = 0.0;  ///< px from the left
  double origin_y = 0.0;  ///< px from the top
};

struct PlacedText {
  Box box;
  std::string text;
};

struct PlacedSwatch {
  Box box;
  double shade = 0.0;
};

/// One picture. Boxes of what the view does not ask for are empty.
struct Layout {
  int width = 0, height = 0;  ///< px
  double em = 0.0;            ///< font size, px
  Camera camera;
  Box bed;  ///< whole pixels; discs are cut here
  std::vector<PlacedText> texts;
  Box bar;                    ///< the gray bar
  std::vector<double> ticks;  ///< x of the ticks below it
  std::vector<PlacedSwatch> swatches;
  Box scale_bar;
  Box arrow;  ///< square; gravity turns about its centre
};

/// Smallest and largest side of a picture, px.
inline constexpr int smallest_width = 200;
inline constexpr int largest_side = 16384;

/// Lays out a picture `width` px wide: caption, bed, legend. The height follows from the aspect of the bed.
/// The font grows with the width, and shrinks where a text would not fit. Throws Error(usage) where nothing
/// legible fits, or where the picture is larger than largest_side.
Layout lay_out(const FrameView& view, int width, const Font& font);

}  // namespace talus
