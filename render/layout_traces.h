#pragma once
/// The layout of the curves below a map.

#include <vector>

#include "render/layout.h"

namespace talus {

/// Lays out traces one below the other, from y down, between `left` and `right`; the last has the labels of
/// all. Labels that would touch are left out. Returns the lower edge, px; negative if nothing legible fits.
double add_traces(Layout& layout, const std::vector<Trace>& traces, double left, double right, double y,
                  const Font& font);

}  // namespace talus
