#pragma once
/// Stress of the whole packing, of sections along it, and of its grains.

#include <vector>

#include "analysis/histogram.h"
#include "core/bed_frame.h"
#include "stress/stress_state.h"

namespace talus::analysis {

/// Mean stress of the packing, sigma = sum of the internal moments of the free grains / V (T20), Pa.
/// Compression is positive; y points away from the floor.
struct PackingStress {
  Tensor2 sigma;
  stress::StressState state;       ///< Gamma is state.ratio (T22)
  double normal = 0.0;             ///< sigma_N = sigma_yy
  double shear = 0.0;              ///< sigma_T = -sigma_yx, positive if gravity pulls towards +x
  double shear_over_normal = 0.0;  ///< sigma_T / sigma_N; NaN if the packing carries nothing
};

/// Returns the area V below the free surface and above the tops of the floor grains, m^2 (bed_volume of
/// stress/free_surface.h).
double frame_volume(const BedFrame& bed);

/// Thickness of the layers at the floor and below the free surface that do not count as bulk, in mean
/// diameters: the floor orders the grains above it, and the surface is rough.
inline constexpr double bulk_margin = 5.0;

/// Returns the share of the area covered by free grains between bulk_margin above the floor and bulk_margin
/// below the mean free surface, volume / length. Disks across these limits count with the part between them.
/// NaN if the limits leave nothing between them.
double bulk_solid_fraction(const BedFrame& bed, double volume);

/// Computes the stress of the packing; `volume` is in m^2.
PackingStress packing_stress(const BedFrame& bed, double volume);

/// Returns the stress of equal sections along the bed, Pa, the first from x = 0: the sum of the moments of
/// the grains with centres in the section, over its area. The area is the width of the section, length /
/// count, times the mean depth of the bed, volume / length (paper, Fig. 6).
std::vector<Tensor2> section_stresses(const BedFrame& bed, double volume, int count);

/// Returns the distribution of gamma over the free grains that carry something, in equal bins over [0, 1]
/// (paper, Fig. 8).
Histogram stress_ratio_distribution(const BedFrame& bed, int bins);

}  // namespace talus::analysis
