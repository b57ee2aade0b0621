#pragma once
/// Distributions.

#include <vector>

namespace talus::analysis {

/// The edges of equal bins.
std::vector<double> equal_edges(double from, double to, int bins);

/// Bins between ascending edges; the last bin includes its upper edge. Values outside are counted apart, NaN
/// is not counted at all.
struct Histogram {
  std::vector<double> edges;    ///< one more than there are bins
  std::vector<double> weight;   ///< sum of the weights in each bin
  std::vector<double> squares;  ///< sum of their squares
  double outside = 0.0;         ///< weight of values outside
  double total = 0.0;           ///< weight of all values

  explicit Histogram(std::vector<double> ascending_edges);
  /// Equal bins.
  Histogram(double from, double to, int bins);

  void add(double value, double weight_of_value = 1.0);

  double width(std::size_t bin) const { return edges[bin + 1] - edges[bin]; }
  double centre(std::size_t bin) const { return 0.5 * (edges[bin] + edges[bin + 1]); }

  /// Probability density in each bin: its integral over all values, those outside included, is 1. Zero where
  /// there are no values.
  std::vector<double> density() const;
  /// Standard error of the density, for independent values (Poisson): sqrt(sum of squared weights) where the
  /// density has the sum of weights.
  std::vector<double> error() const;
};

/// Edges of bins of equal ratio, for distributions over decades. 0 < from < to.
std::vector<double> logarithmic_edges(double from, double to, int bins);

}  // namespace talus::analysis
