#pragma once
/// The furniture of a picture as what the graphics card takes: triangles and lines.

#include <vector>

#include "render/layout.h"

namespace talus {

/// A corner of a triangle: a glyph of the atlas, or a plain area where u < 0.
struct FurnitureVertex {
  float x, y;   ///< px from the left and from the top
  float u, v;   ///< in the atlas
  float shade;  ///< 0 white, 1 black
};

/// A straight line with round ends.
struct Segment {
  float x0, y0, x1, y1;  ///< px from the left and from the top
  float half_width;      ///< px
  float shade;
};

struct Furniture {
  std::vector<FurnitureVertex> triangles;
  std::vector<Segment> segments;
  std::vector<Disc> swatches;  ///< in px: x from the left, y upwards, so that a camera (1, 0, 0) draws them
};

Furniture furnish(const FrameView& view, const Layout& layout, const Font& font, const GlyphAtlas& atlas);

}  // namespace talus
