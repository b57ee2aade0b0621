#pragma once
/// Remarks of `talus solve` on a step in which the bed was moving.

#include <string>

#include "problems/step_problem.h"

namespace talus::app {

/// Whether the bed moved fast enough that the run required a larger tolerance than for a bed at rest.
bool is_moving(const problems::StepTolerance& run_tolerance);

/// Returns a sentence on such a step: the velocity of the bed, the tolerance that the run required, and which
/// of its two tolerances a solve with the residual `eta` has reached.
std::string remark_on_moving(const problems::StepTolerance& run_tolerance, double eta);

}  // namespace talus::app
