#pragma once
/// What a run reports of the steps that did not reach their tolerance.

#include <cstdint>
#include <string>

#include "session/session.h"

namespace talus::app {

/// Up to this share of all steps is usual (docs/solver.md).
inline constexpr double usual_unconverged_share = 0.002;

struct StepRemark {
  bool usual = true;  ///< a plain statement; else a warning
  std::string text;   ///< empty where all steps converged
};
/// `steps` are those of the whole run.
StepRemark remark_on(const session::SolverRecord& record, std::int64_t steps);

}  // namespace talus::app
