#pragma once
/// Workers of an ensemble as parallel processes on this machine, with their progress on stderr; and the
/// trials of `talus perturb` during the run of a member.

#include <functional>
#include <string>
#include <vector>

#include "app/ensemble_report.h"
#include "app/options.h"
#include "core/observables.h"
#include "ensemble/member_state.h"
#include "ensemble/member_task.h"
#include "io/run_file.h"
#include "session/session.h"

namespace talus::app {

struct EnsembleWorkers {
  std::string folder;
  ensemble::ClaimTimes times;
  std::string max_wall;  ///< HH:MM; empty: no limit
  /// Parallel workers, each on one thread; 0: missing members are left to other workers.
  int jobs = processor_count();
};

/// Moves damaged members aside (set_damaged_aside), reports each on stderr, and leaves them waiting to be
/// computed again. Returns their number.
std::size_t restart_damaged_members(const ensemble::EnsemblePlan& plan, ensemble::KnownMembers& known);

/// Computes missing and damaged members of an ensemble. Waits for members that other workers compute, and
/// takes them over if their workers end early; replaces killed workers as long as members finish. With a time
/// limit it does not wait for other workers. Throws Error(stopped) on a signal or when the time is over, the
/// Error of a worker that failed, and as read_ensemble does.
void compute_members(const EnsembleWorkers& workers, ensemble::KnownMembers& known);

/// Removes the frames of finished members that the ensemble no longer keeps, and files left by killed
/// workers. Reports on stderr how many members lost their frames.
void drop_old_frames(const std::string& folder, ensemble::KnownMembers& known);

/// Creates an ensemble in the folder, or adds missing members to the existing one. `inputs`: files that are
/// read and never replaced. Throws as extend_ensemble does, and Error(bad_data), before
/// the ensemble is created, if a run of another scenario has the name of a member.
void begin_ensemble(const std::string& folder, const ensemble::EnsembleManifest& wanted,
                    const std::vector<std::string>& inputs, ensemble::KnownMembers& known);

/// Calls begin_ensemble for the folder of the workers, computes missing members, and writes the averages.
/// Returns the final state of the ensemble. Throws as begin_ensemble and compute_members do.
EnsembleView compute_ensemble(const ensemble::EnsembleManifest& wanted, const EnsembleWorkers& workers,
                              const std::vector<std::string>& inputs);

/// Throws an Error that lists the failed members of a plan, with the exit code of the first; does nothing
/// without failures. `consequence`: "left out of the means".
void refuse_failures(const ensemble::EnsemblePlan& plan, const std::string& consequence);

/// Reports that a worker postpones a member, and which process is writing its run.
void on_wait(const std::string& member, const std::string& writer);

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
