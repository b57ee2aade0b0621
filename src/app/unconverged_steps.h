#pragma once
/// Report on steps that did not reach their tolerance.

#include <cstdint>
#include <string>

#include "session/session.h"

namespace talus::app {

/// Fraction of unconverged steps considered usual (docs/solver.md).
inline constexpr double usual_unconverged_share = 0.002;

struct StepRemark {
  bool usual = true;  ///< false: the text is a warning
  std::string text;   ///< empty if all steps converged
};
/// Returns the remark on a run of `steps` steps in total.
StepRemark remark_on(const session::SolverRecord& record, std::int64_t steps);

}  // namespace talus::app
