#pragma once
/// The box around a bed, as formats of molecular dynamics want one.

#include "analysis/frame_quantities.h"

namespace talus {

/// m. Along x the period, or from wall to wall; along y from the lowest to the highest point of the grains of
/// the frame; across the plane, where nothing is, a mean diameter.
struct BedBounds {
  double x_low = 0.0, x_high = 0.0, y_low = 0.0, y_high = 0.0, z_low = 0.0, z_high = 0.0;
};
BedBounds bed_bounds(const GrainSource& frame);

}  // namespace talus
