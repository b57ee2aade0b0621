#pragma once
/// Perturbation trials on copies of the bed during a run.

#include <csignal>
#include <functional>
#include <vector>

#include "session/perturbation_table.h"
#include "session/session.h"

namespace talus::app {

/// Returns a function for RunControl::trials, which makes the trials of each state of the plan that `known`
/// lacks when the run reaches it, and reports the result on stderr. Trials end with Error(stopped) if `stop`
/// is set.
std::function<std::vector<TrialRow>(const session::Session&)> intermediate_trials(
    session::PerturbationTable known, const volatile std::sig_atomic_t* stop);

}  // namespace talus::app
