#pragma once
/// Histograms and their bins.

#include <vector>

namespace talus::analysis {

/// Returns the edges of bins of equal width.
std::vector<double> equal_edges(double from, double to, int bins);

/// A histogram with ascending bin edges; the last bin includes its upper edge. Values outside the bins are
/// counted separately; NaN is ignored.
struct Histogram {
  std::vector<double> edges;    ///< one more than there are bins
  std::vector<double> weight;   ///< sum of weights in each bin
  std::vector<double> squares;  ///< sum of squared weights in each bin
  double outside = 0.0;         ///< weight of the values outside the bins
  double total = 0.0;           ///< weight of all values

  explicit Histogram(std::vector<double> ascending_edges);
  /// Creates bins of equal width.
  Histogram(double from, double to, int bins);

  /// Adds a value with a weight; NaN is ignored.
  void add(double value, double weight_of_value = 1.0);

  double width(std::size_t bin) const { return edges[bin + 1] - edges[bin]; }
  double centre(std::size_t bin) const { return 0.5 * (edges[bin] + edges[bin + 1]); }

  /// Returns the probability density in each bin, normalised to 1 over all values, including those outside
  /// the bins. Zero if there are no values.
  std::vector<double> density() const;
  /// Returns the standard error of the density for independent values (Poisson): sqrt(sum of squared weights)
  /// in place of the sum of weights.
  std::vector<double> error() const;
};

/// Returns the edges of bins of equal ratio, for distributions over decades. 0 < from < to.
std::vector<double> logarithmic_edges(double from, double to, int bins);

}  // namespace talus::analysis
