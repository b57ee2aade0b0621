#pragma once
/// The furniture of a picture as what a target draws: areas, texts, lines and discs.

#include <vector>

#include "render/layout.h"
#include "render/target.h"

namespace talus::render {

struct Furniture {
  std::vector<Area> areas;
  std::vector<PlacedText> texts;
  std::vector<Line>
      lines;  ///< in px: x from the left, y upwards from the top, so that a plain camera draws them
  std::vector<Disc> discs;  ///< the same
};

Furniture furnish(const FrameView& view, const Layout& layout);

}  // namespace talus::render
