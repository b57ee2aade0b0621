#pragma once
/// The free surface of a bed: the upper envelope of its free grains, in closed form.

#include <vector>

#include "core/world.h"

namespace talus::stress {

/// A piece of the free surface, from the end of the previous piece to its own end: the upper side of a disk,
/// or, with radius 0, the plane y = 0 of the tops of the floor grains.
struct SurfaceArc {
  double end = 0.0;         ///< m along the bed
  double x = 0.0, y = 0.0;  ///< m, centre of the disk or of its periodic image
  double radius = 0.0;      ///< m
};

/// Returns the free surface from x = 0 to the length of the bed, exact to rounding. Disks may overlap;
/// periodic images are included, and parts below y = 0 are not. Empty for a bed without length.
std::vector<SurfaceArc> free_surface(const Grains& grains, const Boundary& boundary);

/// Returns the height of a free surface above y = 0, m, at a position along the bed; outside, that of the
/// nearest end.
double height_of(const std::vector<SurfaceArc>& surface, double place);

/// Returns the area below a part of a free surface and above y = 0, m^2.
double area_below(const std::vector<SurfaceArc>& surface, double from, double to);

/// Returns the area below the free surface and above y = 0, m^2, the volume V of a bed in two dimensions.
double bed_volume(const Grains& grains, const Boundary& boundary);

/// Returns the mean height of the free surface above y = 0 within `half_width` of a position, m, continued
/// periodically in a periodic bed; 0 outside a bed between walls.
double mean_height(const Grains& grains, const Boundary& boundary, double centre, double half_width);

/// Returns the slope of the free surface relative to the floor, rad, positive if it rises along x: that of
/// the least-squares line through the middle half of the bed, L/4 ... 3 L/4, away from the walls. 0 in a
/// periodic bed, whose surface has the same height at both ends.
double surface_inclination(const Grains& grains, const Boundary& boundary);

}  // namespace talus::stress
