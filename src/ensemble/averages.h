#pragma once
/// Averages over the members of an ensemble: scalar results, and every quantity of the analysis on a common
/// grid of tilt and on a grid of theta_c - theta.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/statistics.h"
#include "ensemble/member_values.h"

namespace talus::ensemble {

/// A quantity at the points of a grid.
struct AveragedQuantity {
  std::string name;  ///< same name as in the tables of the members
  std::string unit;
  std::vector<double> values;      ///< members x points; NaN if a member has no value there
  std::vector<Summary> summaries;  ///< statistics over the members, one for each point
};

/// Quantities on a common grid.
struct AveragedCurves {
  std::vector<double> angles;  ///< deg, multiples of the frame spacing, starting at 0
  std::vector<AveragedQuantity> quantities;
};

/// Correlations between the angles of events: theta_c, first_slide, theta_r, and theta_d by each estimator.
struct AngleCorrelations {
  std::vector<std::string> names;
  std::vector<Correlation> pairs;  ///< names x names, row by row
};

/// The averages of one variant.
struct Averages {
  std::vector<std::uint64_t> seeds;
  std::vector<std::string> state_hashes;
  std::vector<AveragedQuantity> numbers;  ///< scalar results, each with one point
  AngleCorrelations correlations;
  AveragedCurves over_tilt;
  AveragedCurves before_failure;  ///< grid of theta_c - theta; no quantities if no slope failed
};

/// Averages members that are in the order of their seeds. `frame_every` is the spacing of the grids, deg.
/// Values between frames are interpolated linearly and never extrapolated, so that a member contributes up to
/// its last frame before theta_c. The result depends only on the set of members, not on the order in which
/// they finished.
Averages averages_of(const std::vector<MemberResult>& members, double frame_every);

/// Returns the points of a grid: multiples of the spacing from 0 to `largest`, deg.
std::vector<double> grid_up_to(double largest, double spacing);

/// Interpolates a series linearly at `theta` (deg); NaN outside the range of its frames.
double interpolated(const std::vector<double>& tilts, const std::vector<double>& values, double theta);

}  // namespace talus::ensemble
