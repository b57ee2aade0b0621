#pragma once
/// Spatial pair correlation of a quantity.

#include <vector>

#include "core/bed_frame.h"

namespace talus::analysis {

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
