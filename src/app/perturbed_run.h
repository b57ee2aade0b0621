#pragma once
/// A run that is perturbed on its way: trials on copies of the bed.

#include <csignal>
#include <functional>
#include <vector>

#include "session/perturbation_table.h"
#include "session/session.h"

namespace talus::app {

/// Makes the trials of each state of the plan that `known` does not have yet, once the run comes to it, and
/// says on stderr what was found: for RunControl::trials. They end with Error(stopped) where `stop` is set.
std::function<std::vector<TrialRow>(const session::Session&)> trials_on_the_way(
    session::PerturbationTable known, const volatile std::sig_atomic_t* stop);

}  // namespace talus::app
