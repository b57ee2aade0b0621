#pragma once
/// Workers of an ensemble as parallel processes on this machine, with their progress on stderr.

#include <string>
#include <vector>

#include "app/ensemble_report.h"
#include "ensemble/claim.h"

namespace talus::app {

struct EnsembleWorkers {
  std::string folder;
  ensemble::ClaimTimes times;
  std::string max_wall;  ///< HH:MM; empty: no limit
  int jobs = 1;  ///< parallel workers, each on one thread; 0: missing members are left to other workers
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

/// Throws Error(bad_data) if the folder has the table of a member without its run, as an earlier version of
/// Talus left it.
void refuse_old_tables(const ensemble::EnsemblePlan& plan);

/// Creates an ensemble in the folder, or adds missing members to the existing one. `inputs`: files that are
/// read and never replaced. Throws as extend_ensemble and refuse_old_tables do, and Error(bad_data), before
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

}  // namespace talus::app
