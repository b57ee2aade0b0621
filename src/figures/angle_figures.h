#pragma once
/// The angles at which something happens in a run, over the runs of an ensemble: how they are distributed,
/// and how they go together.

#include <optional>
#include <span>
#include <vector>

#include "figures/figure.h"
#include "figures/run_angles.h"

namespace talus {

/// Bins of equal width, and where the first of them begins.
struct HistogramBins {
  double first = 0.0, width = 0.0;
  std::size_t count = 0;
};

/// Bins for these values, of which at least one is a number: about as wide as Freedman and Diaconis (1981)
/// have them, 2 IQR n^(-1/3), but a round number; an empty one on either side.
HistogramBins bins_for(const std::vector<double>& values);

/// The histogram of each angle, with mean, standard error, median and number.
std::optional<Figure> angle_distributions(std::span<const RunGroup> groups);

/// Each angle over each other one, with Pearson's coefficient; theta_d at the first threshold only.
std::optional<Figure> angle_correlations(std::span<const RunGroup> groups);

}  // namespace talus
