#pragma once
/// Trials of `talus perturb` during the run of a member of an ensemble.

#include <functional>
#include <string>
#include <vector>

#include "core/trial_row.h"
#include "ensemble/member_task.h"
#include "io/run_file.h"
#include "session/session.h"

namespace talus::app {

/// Fact in the provenance of a run that states the plan of its trials, as plan_text does.
inline constexpr const char* trials_fact = "trials";

/// Throws Error(bad_data) if the run `path` does not have the trials of this plan.
void require_trials(const io::RunFile& run, const ensemble::TrialsTask& plan, const std::string& path);

/// Returns a function for RunControl::trials of the run `path`: when the run reaches a state of the plan
/// whose trials are not stored yet, talus.perturb makes them on a copy of the bed that is held at its tilt.
/// Throws as require_trials and output_of_python_module do.
std::function<std::vector<TrialRow>(const session::Session&)> member_trials(const ensemble::TrialsTask& plan,
                                                                            const std::string& path);

}  // namespace talus::app
