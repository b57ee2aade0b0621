#pragma once
/// Stress of the packing as a whole, of sections along it, and of its grains.

#include <vector>

#include "analysis/histogram.h"
#include "core/bed_frame.h"
#include "stress/stress_state.h"

namespace talus::analysis {

/// sigma = sum of the internal moments of the free grains / V (T20), Pa; compression is
/// positive, y points away from the floor.
struct PackingStress {
  Tensor2 sigma;
  stress::StressState state;       ///< Gamma is state.ratio (T22)
  double normal = 0.0;             ///< sigma_N = sigma_yy
  double shear = 0.0;              ///< sigma_T = -sigma_yx, positive where gravity pulls towards +x
  double shear_over_normal = 0.0;  ///< sigma_T / sigma_N; NaN where nothing is carried
};

/// Area V below the free surface and above the tops of the floor grains, m^2 (bed_volume of
/// stress/free_surface.h).
double frame_volume(const BedFrame& bed);

/// Layers at the floor and below the free surface that are not the bulk of a bed, in mean diameters: the
/// floor orders the grains above it, and the surface is rough.
inline constexpr double bulk_margin = 5.0;

/// Share of the area that the free grains cover, between bulk_margin above the floor and bulk_margin below
/// the mean free surface, volume / length; the parts of discs that lie between. NaN where nothing lies
/// between.
double bulk_solid_fraction(const BedFrame& bed, double volume);

/// `volume` in m^2.
PackingStress packing_stress(const BedFrame& bed, double volume);

/// Stress of equal sections along the bed, Pa, the first from x = 0: the sum of the moments of the grains
/// whose centre is in the section, over its area. The area is its width, length / count, times the mean depth
/// of the bed, volume / length. Paper, Fig. 6.
std::vector<Tensor2> section_stresses(const BedFrame& bed, double volume, int count);

/// Stress ratios gamma of the free grains that carry something, in equal bins over [0, 1]. Paper, Fig. 8.
Histogram stress_ratio_distribution(const BedFrame& bed, int bins);

}  // namespace talus::analysis
