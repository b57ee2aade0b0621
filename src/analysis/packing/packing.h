#pragma once
/// Stress of the whole packing, of sections along it, and of its grains; solid fraction around each grain.

#include <vector>

#include "analysis/histogram.h"
#include "analysis/record.h"
#include "core/snapshot.h"

namespace talus::analysis {

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

/// Sets the mean stress of the packing, sigma = sum of the internal moments of the free grains / V (T20), Pa;
/// sigma_T / sigma_N = -sigma_yx / sigma_yy, positive if gravity pulls towards +x; and Gamma (T22).
/// Compression is positive; y points away from the floor. NaN if the packing carries nothing. `volume` is in
/// m^2.
void measure_packing_stress(const BedFrame& bed, double volume, FrameRecord& record);

/// Returns the stress of equal sections along the bed, Pa, the first from x = 0: the sum of the moments of
/// the grains with centres in the section, over its area. The area is the width of the section, length /
/// count, times the mean depth of the bed, volume / length (paper, Fig. 6).
std::vector<Tensor2> section_stresses(const BedFrame& bed, double volume, int count);

/// Returns the distribution of gamma over the free grains that carry something, in equal bins over [0, 1]
/// (paper, Fig. 8).
Histogram stress_ratio_distribution(const BedFrame& bed, int bins);

// Radical cells of the grains and local solid fractions.

/// Largest power |x - x_i|^2 - r_i^2 of a point in a cell, in D^2: that of the hole in a ring of six grains
/// of diameter D. Points of larger power to all grains lie above the bed.
inline constexpr double largest_power = 0.75;

/// The cell of a grain in the radical (power, Laguerre) diagram of the disks: the points whose power to this
/// grain is lower than to any other. Unlike Voronoi cells of the centres, radical cells never cut a disk of a
/// different size. Walls and a smooth floor bound the cells, as do the cells of floor grains. (T30)
struct GrainCell {
  /// Corners, m, counter-clockwise; those of an open cell may lie beyond the largest power.
  std::vector<Vec2> corners;
  bool is_open = false;  ///< whether it extends beyond the largest power: the grain is at the free surface

  double area() const;  ///< m^2
};

/// Returns the cell of each free grain. Only the nearest periodic image of a neighbour counts.
std::vector<GrainCell> grain_cells(const BedFrame& bed);

/// Returns the area of each free grain over that of its cell; NaN if the cell is open.
std::vector<double> local_solid_fractions(const BedFrame& bed);

/// Sets members of a record that are defined in the table of quantities.
void measure_local_solid_fraction(const BedFrame& bed, FrameRecord& record);

// Spatial pair correlation of a quantity.

/// C(r) = <dv_i dv_j> / <dv^2> over pairs of points, in equal bins of their distance r from 0 to `largest`
/// (m); dv is the deviation from the mean. Points with the value NaN are left out.
struct PairCorrelation {
  std::vector<double> r;      ///< centre of each bin, m
  std::vector<double> value;  ///< NaN if a bin has no pairs, or if all values are equal
  std::vector<double> pairs;  ///< number of pairs in each bin
};

/// Computes the pair correlation. `period` is in m, 0 if the bed is not periodic. In a periodic bed, pairs
/// count up to half a period.
PairCorrelation pair_correlation(const std::vector<double>& x, const std::vector<double>& y,
                                 const std::vector<double>& value, double largest, int bins, double period);

/// Correlates the normal forces at the contact points, each divided by the mean of its layer of two mean
/// diameters. The division removes the weight of the grains above, which all forces at one depth share.
PairCorrelation force_correlation(const BedFrame& bed, double largest, int bins);
/// Correlates the stress ratios gamma of the free grains, at their centres.
PairCorrelation stress_ratio_correlation(const BedFrame& bed, double largest, int bins);
/// Correlates the mean stresses of the free grains, the trace of the internal moment over pi r^2, at their
/// centres, each divided by the mean of its layer as for forces. A grain that carries nothing has 0.
PairCorrelation mean_stress_correlation(const BedFrame& bed, double largest, int bins);

}  // namespace talus::analysis
