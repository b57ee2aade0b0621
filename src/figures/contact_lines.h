#pragma once
/// Contacts as lines between centres, and the outline of the bed, for drawing.

#include <vector>

#include "core/bed_frame.h"

namespace talus::figures {

/// A contact, or its part on one side of the periodic edge; coordinates in m.
struct ContactLine {
  double x1 = 0.0, y1 = 0.0, x2 = 0.0, y2 = 0.0;
  Index contact = 0;
};

/// Returns lines from centre to centre, or from centre to contact point at a wall, in the order of the
/// contacts. A contact across the periodic edge is cut there into two lines.
std::vector<ContactLine> contact_lines(const BedFrame& bed);

/// The free surface (stress/free_surface.h), sampled every 0.25 D from edge to edge: x and y, m.
struct SurfaceLine {
  std::vector<double> x, y;
};
/// Returns the free surface of a bed.
SurfaceLine surface_line(const BedFrame& bed);

}  // namespace talus::figures
