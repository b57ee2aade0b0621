#pragma once
/// The furniture of a picture as what a target draws: triangles, lines and discs.

#include <vector>

#include "render/layout.h"
#include "render/target.h"

namespace talus::render {

struct Furniture {
  std::vector<FurnitureVertex> triangles;
  std::vector<Line>
      lines;  ///< in px: x from the left, y upwards from the top, so that a plain camera draws them
  std::vector<Disc> discs;  ///< the same
};

Furniture furnish(const FrameView& view, const Layout& layout, const Font& font, const GlyphAtlas& atlas);

}  // namespace talus::render
