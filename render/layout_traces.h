#pragma once
/// The layout of the curves below a map.

#include <vector>

#include "render/layout.h"

namespace talus::render {

/// The part of a picture that is available to traces, px, and whether their titles may be broken into lines.
struct TraceRoom {
  double left = 0.0, right = 0.0, top = 0.0;
  bool broken = false;
  double frame_height = 5.0;  ///< height in font sizes
};

/// Lays out traces one below the other; the last carries the labels of all. Labels that would touch are
/// omitted. Returns the lower edge, px; negative if nothing legible fits.
double add_traces(Layout& layout, const std::vector<Trace>& traces, const TraceRoom& room, const Font& font);

}  // namespace talus::render
