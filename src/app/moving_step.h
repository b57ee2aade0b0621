#pragma once
/// What `talus solve` says of a step of a run in which the bed was moving.

#include <string>

#include "problems/step_problem.h"

namespace talus::app {

/// Whether the bed moved so fast that the run asked less of the step than of a bed at rest.
bool is_moving(const problems::StepTolerance& of_run);

/// A sentence on such a step: how fast the bed moved, what the run therefore asked, and which of its two
/// tolerances a solve with the residual `eta` has reached.
std::string remark_on_moving(const problems::StepTolerance& of_run, double eta);

}  // namespace talus::app
