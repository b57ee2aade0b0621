#pragma once
/// What announces failure best: every number of a frame, ranked by how well it tells the distance of a single
/// bed from its failure.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ensemble/distance_told.h"
#include "figures/figure.h"
#include "figures/run_group.h"

namespace talus {

/// Distances from failure at which a measure is read, deg: equally spaced, up to the last.
std::vector<double> distances_of_ranking();

/// What is known of one measure.
struct RankedMeasure {
  std::string name;   ///< as files have it: "overloaded/fraction[1]"
  std::string label;  ///< its title, or its name where it has none
  std::string definition;
  bool by_own_failure = false;  ///< at thresholds that follow from the theta_c of each bed
  /// Its change since far from failure, over the standard deviation of the beds, 1, 2 and 3 deg before
  /// theta_c.
  std::vector<double> contrast{};
  /// Of the distance that it tells, deg: over all distances, and 1, 2 and 3 deg before theta_c.
  RootMeanSquare error{};
  std::vector<double> error_at{};
  RootMeanSquare error_with_tilt{};  ///< where the tilt is known as well
  /// By how much it lowers the mean square error of the tilt, deg^2, bed by bed, and its standard error.
  double gain = 0.0, gain_error = 0.0;
  std::size_t beds = 0;  ///< that have it
};

/// Of the tilt itself, then of each number of frames that varies over the beds, those with the least error
/// first. Each is compared with itself far from failure, its mean from 5 to 10 deg of tilt: by the logarithm
/// of their ratio where it is above zero in all beds throughout, else by their difference.
std::vector<RankedMeasure> ranked_measures(const RunGroup& group);

/// The ranking of the first group of at least eight failed runs; nothing where there is none.
std::optional<Figure> ranking_figure(std::span<const RunGroup> groups);

}  // namespace talus
