#pragma once
/// All estimators of theta_d of a run.

#include <cstddef>
#include <string>
#include <vector>

#include "analysis/quantities.h"
#include "figures/run_group.h"

namespace talus::figures {

/// An estimator of theta_d, for one strain or threshold, and its labels.
struct Estimator {
  analysis::QuantityMember member;
  std::size_t element;
  std::string label;    ///< axis label in enhanced text
  std::string meaning;  ///< description in a table
};

/// Returns the onset of dilation, percolation and the jump of the largest l_c, for either strain and for each
/// threshold, in reverse order.
std::vector<Estimator> estimators_of(const runs::RunView& run);

/// Returns theta_d in deg; NaN if the run has none.
double theta_d_of(const runs::RunView& run, const Estimator& estimator);

/// Returns the first run with thresholds, which has all estimators, or else the first run.
const runs::RunView& max_analysed(const std::vector<const runs::RunView*>& runs);

}  // namespace talus::figures
