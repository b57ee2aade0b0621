#pragma once
/// All estimators of theta_d that a run has.

#include <cstddef>
#include <string>
#include <vector>

#include "analysis/quantities.h"
#include "figures/run_group.h"

namespace talus::figures {

/// An estimator of theta_d, by which strain or threshold, and how it is called.
struct Estimator {
  analysis::QuantityMember member;
  std::size_t element;
  std::string label;    ///< for an axis, in enhanced text
  std::string meaning;  ///< for a table
};

/// Onset of dilation, percolation and jump of the largest l_c, by either strain and at each threshold, the
/// first ones last.
std::vector<Estimator> estimators_of(const runs::RunView& run);

/// deg; NaN where the run has none.
double theta_d_of(const runs::RunView& run, const Estimator& estimator);

/// The first run with thresholds, which has all estimators; else the first of all.
const runs::RunView& most_analysed(const std::vector<const runs::RunView*>& runs);

}  // namespace talus::figures
