#pragma once
/// The free surface of a bed: the upper envelope of its free grains as seen from above.

#include <vector>

#include "core/world.h"

namespace talus {

/// Height of the free surface above y = 0 (the tops of the floor grains), m, at the middle of each of the
/// ceil(L / spacing) equal sections of the bed; 0 where no grain covers it.
std::vector<double> free_surface(const Grains& grains, const Boundary& boundary, double spacing);

/// Slope of the free surface against the floor, rad, positive where it rises along x: of the least-squares
/// line through the middle half of the bed, L/4 ... 3 L/4, away from the walls. 0 in a periodic bed, whose
/// surface ends at the height at which it begins.
double surface_inclination(const Grains& grains, const Boundary& boundary, double spacing);

}  // namespace talus
