#include "analysis/failure/failure_ratio.h"

#include <cmath>
#include <vector>

#include "core/statistics.h"
#include "core/trigonometry.h"

namespace talus::analysis {

FailureRatio failure_ratio(std::span<const double> tilts, std::span<const double> ratios, double theta_c,
                           double window) {
  std::vector<double> found;
  for (std::size_t k = 0; k < tilts.size(); ++k)
    if (tilts[k] > 0.0 && tilts[k] <= theta_c && tilts[k] > theta_c - window)
      found.push_back(ratios[k] * cosine(tilts[k]) / sine(tilts[k]));
  const Statistics result = statistics_of(found);
  return {result.mean, result.deviation};
}

}  // namespace talus::analysis
