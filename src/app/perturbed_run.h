#pragma once
/// A run that is perturbed on its way: trials on copies of the bed, and the table of them beside the run.

#include <csignal>
#include <functional>
#include <string>

#include "session/perturbation_table.h"
#include "session/run.h"

namespace talus {

/// After the name of a member, of the table of its trials.
inline constexpr const char* trials_ending = ".trials.csv";

/// The trials of the run at this path, "seed-1.trials.csv" beside it. Throws Error(bad_data) where a run is
/// there and no such table, and as parse_perturbation_csv does.
PerturbationTable read_trials(const std::string& run, const PerturbationPlan& plan);

/// Makes the trials of each state of the plan that is not in the table yet, once the run comes to it, and
/// says on stderr what was found: for RunControl::on_step. The table of a run that has not begun is begun. It
/// is written after each state, before the run commits what comes after it, so that neither is ever ahead of
/// what it needs. Trials end with Error(stopped) where `stop` is set. Throws as read_trials does.
std::function<void(const RunProgress&)> trials_on_the_way(const std::string& run,
                                                          const PerturbationPlan& plan,
                                                          const volatile std::sig_atomic_t* stop);

/// Marks the table of a run that is complete as complete. Throws as read_trials does.
void complete_trials(const std::string& run, const PerturbationPlan& plan);

}  // namespace talus
