#pragma once
/// The furniture of a picture as a target draws it: areas, texts, lines and discs.

#include <vector>

#include "render/layout.h"
#include "render/target.h"

namespace talus::render {

struct Furniture {
  std::vector<Area> areas;
  std::vector<PlacedText> texts;
  std::vector<Line>
      lines;  ///< px: x from the left, y upwards from the top, so that a plain camera draws them
  std::vector<Disc> discs;  ///< same coordinates
};

Furniture furnish(const FrameView& view, const Layout& layout);

}  // namespace talus::render
