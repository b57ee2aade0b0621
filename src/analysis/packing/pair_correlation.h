#pragma once
/// Correlation of a quantity between two points, over their distance.

#include <vector>

#include "core/bed_frame.h"

namespace talus::analysis {

/// C(r) = <dv_i dv_j> / <dv^2> over pairs of points at distances in equal bins of r from 0 to `largest` (m);
/// dv is the deviation from the mean. Points whose value is NaN are left out.
struct PairCorrelation {
  std::vector<double> r;      ///< m, the middle of each bin
  std::vector<double> value;  ///< NaN where no pair is so far apart, or all values are equal
  std::vector<double> pairs;  ///< number of pairs in each bin
};

/// `period` in m, 0 where the bed is not periodic. In a periodic bed pairs count up to half a period.
PairCorrelation pair_correlation(const std::vector<double>& x, const std::vector<double>& y,
                                 const std::vector<double>& value, double largest, int bins, double period);

/// Of the normal forces, at the contact points; each over the mean of its layer, so that the weight of the
/// grains above, which all forces at one depth share, is no correlation. Layers are two mean diameters thick.
PairCorrelation force_correlation(const BedFrame& bed, double largest, int bins);
/// Of the stress ratios gamma of the free grains, at their centres.
PairCorrelation stress_ratio_correlation(const BedFrame& bed, double largest, int bins);
/// Of the mean stresses of the free grains, trace of the internal moment over pi r^2, at their centres; each
/// over the mean of its layer, like forces. A grain that carries nothing has 0.
PairCorrelation mean_stress_correlation(const BedFrame& bed, double largest, int bins);

}  // namespace talus::analysis
