#pragma once
/// Averages over the members of an ensemble: every quantity of the analysis on a common grid of tilt, and
/// again over the angle that is left to theta_c; and the numbers that there is one of in a run.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/statistics.h"
#include "ensemble/member_values.h"

namespace talus::ensemble {

/// A quantity at the points of a grid.
struct AveragedQuantity {
  std::string name;  ///< as in the tables of the members
  std::string unit;
  std::vector<double> values;      ///< member by member, in each by point; NaN where it has none
  std::vector<Summary> summaries;  ///< of the members, at each point
};

/// Quantities on a common grid.
struct AveragedCurves {
  std::vector<double> angles;  ///< deg, multiples of the spacing of frames, from 0 on
  std::vector<AveragedQuantity> quantities;
};

/// How the angles at which something happens go together: theta_c, first_slide, theta_r, and theta_d by each
/// estimator.
struct AngleCorrelations {
  std::vector<std::string> names;
  std::vector<Correlation> pairs;  ///< row by row, names x names
};

/// The averages of one variant.
struct Averages {
  std::vector<std::uint64_t> seeds;
  std::vector<std::string> state_hashes;
  std::vector<AveragedQuantity> numbers;  ///< each with one point
  AngleCorrelations correlations;
  AveragedCurves over_tilt;
  AveragedCurves before_failure;  ///< over theta_c - theta; without quantities where no slope failed
};

/// Of members in the order of the seeds. `frame_every`: spacing of the grids, deg. Values between frames are
/// interpolated linearly; none is extrapolated, so that a member counts up to its last frame before theta_c.
/// The result does not depend on when members came, only on which there are.
Averages averages_of(const std::vector<MemberResult>& members, double frame_every);

/// Multiples of the spacing from 0 up to `largest`, deg: the points of a grid.
std::vector<double> grid_up_to(double largest, double spacing);

/// The value of a series at `theta` (deg), between the two frames around it; NaN outside of the frames.
double interpolated(const std::vector<double>& tilts, const std::vector<double>& values, double theta);

}  // namespace talus::ensemble
