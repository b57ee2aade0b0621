#pragma once
/// Contacts as lines between centres, and the outline of the bed, for drawing.

#include <vector>

#include "core/bed_frame.h"

namespace talus::figures {

/// A contact, or the part of it on one side of the periodic edge; m.
struct ContactLine {
  double x1 = 0.0, y1 = 0.0, x2 = 0.0, y2 = 0.0;
  Index contact = 0;
};

/// From centre to centre, and from centre to contact point at a wall. A contact across the periodic edge is
/// cut there: it has two lines. In the order of the contacts.
std::vector<ContactLine> contact_lines(const BedFrame& bed);

/// The free surface (stress/free_surface.h), sampled every 0.25 D: x and y, m, from edge to edge.
struct SurfaceLine {
  std::vector<double> x, y;
};
SurfaceLine surface_line(const BedFrame& bed);

}  // namespace talus::figures
