#pragma once
/// The free surface of a bed: the upper envelope of its free grains as seen from above, in closed form.

#include <vector>

#include "core/world.h"

namespace talus::stress {

/// A piece of the free surface, from the end of the piece before it to its own: the upper side of a disk, or,
/// with radius 0, the plane y = 0 of the tops of the floor grains.
struct SurfaceArc {
  double end = 0.0;         ///< m along the bed
  double x = 0.0, y = 0.0;  ///< m, centre of the disk; that of its image in a periodic bed
  double radius = 0.0;      ///< m
};

/// The free surface from x = 0 to the length of the bed, exact to rounding: disks may overlap, in a periodic
/// bed their images count, and what lies below y = 0 does not. Empty for a bed without length.
std::vector<SurfaceArc> free_surface(const Grains& grains, const Boundary& boundary);

/// Height of a free surface above y = 0, m, at a place along the bed; that of its nearest end outside.
double height_of(const std::vector<SurfaceArc>& surface, double place);

/// Area below a part of a free surface and above y = 0, m^2.
double area_below(const std::vector<SurfaceArc>& surface, double from, double to);

/// Area below the free surface and above y = 0, m^2: the volume V of a bed in two dimensions.
double bed_volume(const Grains& grains, const Boundary& boundary);

/// Slope of the free surface against the floor, rad, positive where it rises along x: of the least-squares
/// line through the middle half of the bed, L/4 ... 3 L/4, away from the walls. 0 in a periodic bed, whose
/// surface ends at the height at which it begins.
double surface_inclination(const Grains& grains, const Boundary& boundary);

}  // namespace talus::stress
