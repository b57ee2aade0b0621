#include "ensemble/distance_told.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "core/statistics.h"
#include "core/types.h"

namespace talus {
namespace {

// Two measures that go together more closely than this are one: beyond it rounding decides.
constexpr double closest_correlation = 0.999;
// Of the beds at one distance, over that of all beds at all distances: what hardly varies where a few beds
// calibrate it (a count that is still zero in all of them) is not known that well.
constexpr double least_deviation = 0.01;

using Pair = std::array<double, 2>;

/// The normal distribution of one measure over beds, or of two.
struct Normal {
  Pair mean{}, deviation{};
  double correlation = 0.0;
};

/// The measures of all beds, first or both; what is missing is NaN.
struct Measures {
  const BedCurves* first = nullptr;
  const BedCurves* second = nullptr;

  std::optional<Pair> at(std::size_t bed, std::size_t k) const {
    const Pair found = {(*first)[bed][k], second == nullptr ? 0.0 : (*second)[bed][k]};
    return std::isnan(found[0]) || std::isnan(found[1]) ? std::nullopt : std::optional(found);
  }
};

/// The standard deviation of all that is known of a measure.
double deviation_of_all(const BedCurves* measure) {
  std::vector<double> values;
  if (measure != nullptr)
    for (const std::vector<double>& bed : *measure) values.insert(values.end(), bed.begin(), bed.end());
  return statistics_of(values).deviation;
}

/// Of all beds but one at distance k; `scale`: the deviation of each measure over all distances.
std::optional<Normal> of_others(const Measures& measures, std::size_t left_out, std::size_t k,
                                const Pair& scale) {
  std::array<std::vector<double>, 2> values;
  for (std::size_t bed = 0; bed < measures.first->size(); ++bed) {
    if (bed == left_out) continue;
    const std::optional<Pair> value = measures.at(bed, k);
    for (std::size_t m = 0; value && m < 2; ++m) values[m].push_back((*value)[m]);
  }
  if (values[0].size() < fewest_to_calibrate) return std::nullopt;
  Normal normal;
  for (std::size_t m = 0; m < (measures.second == nullptr ? 1u : 2u); ++m) {
    const Statistics statistics = statistics_of(values[m]);
    normal.mean[m] = statistics.mean;
    normal.deviation[m] = std::max(statistics.deviation, least_deviation * scale[m]);
  }
  if (measures.second == nullptr) return normal;
  const double correlation = correlation_of(values[0], values[1]).coefficient;
  if (!std::isnan(correlation))
    normal.correlation = std::clamp(correlation, -closest_correlation, closest_correlation);
  return normal;
}

/// Logarithm of the density at a value, but for what does not depend on the distance.
double log_density(const Normal& normal, const Pair& value, bool both) {
  const double first = (value[0] - normal.mean[0]) / normal.deviation[0];
  if (!both) return -0.5 * first * first - std::log(normal.deviation[0]);
  const double second = (value[1] - normal.mean[1]) / normal.deviation[1];
  const double rest = 1.0 - normal.correlation * normal.correlation;
  return -0.5 * (first * first - 2.0 * normal.correlation * first * second + second * second) / rest -
         std::log(normal.deviation[0] * normal.deviation[1] * std::sqrt(rest));
}

/// The mean of the distances, each as likely as the value is there.
double expected_distance(std::span<const double> distances, const std::vector<Normal>& normals,
                         const Pair& value, bool both) {
  std::vector<double> logs;
  for (const Normal& normal : normals) logs.push_back(log_density(normal, value, both));
  const double most = std::ranges::max(logs);
  double weights = 0.0, sum = 0.0;
  for (std::size_t k = 0; k < distances.size(); ++k) {
    const double weight = std::exp(logs[k] - most);
    weights += weight;
    sum += weight * distances[k];
  }
  return sum / weights;
}

/// How the other beds are distributed at every distance; nothing where some distance cannot be calibrated.
std::vector<Normal> calibrated(const Measures& measures, std::size_t left_out, std::size_t distances,
                               const Pair& scale) {
  std::vector<Normal> normals;
  for (std::size_t k = 0; k < distances; ++k) {
    const std::optional<Normal> normal = of_others(measures, left_out, k, scale);
    if (!normal) return {};
    normals.push_back(*normal);
  }
  return normals;
}

/// The square of the error of a bed at each distance; NaN where it has no measure.
std::vector<double> squares_of(std::span<const double> distances, const Measures& measures, std::size_t bed,
                               const Pair& scale) {
  const std::vector<Normal> normals = calibrated(measures, bed, distances.size(), scale);
  std::vector<double> squares(distances.size(), not_known);
  for (std::size_t k = 0; k < distances.size() && !normals.empty(); ++k)
    if (const std::optional<Pair> value = measures.at(bed, k)) {
      const double miss =
          expected_distance(distances, normals, *value, measures.second != nullptr) - distances[k];
      squares[k] = miss * miss;
    }
  return squares;
}

DistanceTold told(std::span<const double> distances, const Measures& measures) {
  const Pair scale = {deviation_of_all(measures.first), deviation_of_all(measures.second)};
  DistanceTold result;
  if (!(scale[0] > 0.0) || (measures.second != nullptr && !(scale[1] > 0.0))) {
    result.mean_square.assign(measures.first->size(), not_known);
    result.error.assign(distances.size(), not_known);
    return result;
  }
  std::vector<std::vector<double>> squares_at(distances.size());
  for (std::size_t bed = 0; bed < measures.first->size(); ++bed) {
    const std::vector<double> squares = squares_of(distances, measures, bed, scale);
    for (std::size_t k = 0; k < distances.size(); ++k) squares_at[k].push_back(squares[k]);
    const Statistics of_bed = statistics_of(squares);
    result.mean_square.push_back(of_bed.mean);
    if (of_bed.count > 0) ++result.beds;
  }
  for (const std::vector<double>& squares : squares_at)
    result.error.push_back(std::sqrt(statistics_of(squares).mean));
  return result;
}

}  // namespace

DistanceTold distance_told(std::span<const double> distances, const BedCurves& measure) {
  return told(distances, {&measure, nullptr});
}

DistanceTold distance_told(std::span<const double> distances, const BedCurves& first,
                           const BedCurves& second) {
  return told(distances, {&first, &second});
}

RootMeanSquare root_mean_square(std::span<const double> mean_squares) {
  const Statistics statistics = statistics_of(mean_squares);
  if (statistics.count < 2) return {not_known, not_known};
  const double value = std::sqrt(statistics.mean);
  return {value, value > 0.0 ? 0.5 * statistics.error / value : 0.0};
}

}  // namespace talus
