#pragma once
/// Circles about grains.

#include "core/snapshot.h"
#include "core/types.h"
#include "render/frame_view.h"

namespace talus {

/// Of what is selected, and of where it has been.
inline constexpr Colour selection_colour{0, 90, 220}, trail_colour{0, 60, 150};

/// A circle of straight lines, with its images in a periodic bed.
void add_circle(FrameView& view, Vec2 centre, double radius, double half_width, const Colour& colour,
                const RunStatics& statics, int circle_lines = 64);

}  // namespace talus
