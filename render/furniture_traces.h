#pragma once
/// Drawing of the curves below a map.

#include "render/furniture.h"

namespace talus::render {

/// Adds a frame with ticks, the curve, and the mark of the frame shown. `em` is the font size and `line` the
/// width of thin lines, px.
void add_trace(Furniture& furniture, const PlacedTrace& trace, double em, double line);

}  // namespace talus::render
