#pragma once
/// Workers of an ensemble as processes side by side on this machine, with their progress on stderr.

#include <string>
#include <vector>

#include "app/ensemble_report.h"
#include "ensemble/claim.h"

namespace talus::app {

struct EnsembleWorkers {
  std::string folder;
  ensemble::ClaimTimes times;
  std::string max_wall;  ///< HH:MM; empty: no limit
  int jobs = 1;          ///< workers side by side, each on one thread; 0: what is missing is left to others
};

/// Members whose files are damaged make way (set_damaged_aside) and wait to be computed again, which is said
/// on stderr. Returns how many.
std::size_t begin_damaged_anew(const ensemble::EnsemblePlan& plan, ensemble::KnownMembers& known);

/// Computes what is missing of an ensemble, damaged members anew. Members that others compute are waited for,
/// and taken over where their workers end before them; workers that were killed are replaced, as long as
/// members come to an end. With a limit of time others are left alone. Throws Error(stopped) on a signal or
/// where the time is over, the Error of a worker that ended with one, and as read_ensemble does.
void compute_members(const EnsembleWorkers& workers, ensemble::KnownMembers& known);

/// Removes frames that the ensemble does not keep, of members that were done before it was told to keep less,
/// and what workers have left that were killed. Says on stderr how many members lost their frames.
void drop_old_frames(const std::string& folder, ensemble::KnownMembers& known);

/// Throws Error(bad_data) where an earlier version of Talus has kept tables of a member and not its run.
void refuse_old_tables(const ensemble::EnsemblePlan& plan);

/// Begins an ensemble in the folder, or adds to the one that is there what it lacks. `inputs`: files that are
/// read, and never replaced. Throws as extend_ensemble does, and Error(bad_data), before an ensemble is
/// begun, where a run of another scenario has the name of a member, and as refuse_old_tables does.
void begin_ensemble(const std::string& folder, const ensemble::EnsembleManifest& wanted,
                    const std::vector<std::string>& inputs, ensemble::KnownMembers& known);

/// Does that in the folder of the workers, computes what is missing, and writes the averages. Returns how far
/// the ensemble is then. Throws as begin_ensemble and compute_members do.
EnsembleView compute_ensemble(const ensemble::EnsembleManifest& wanted, const EnsembleWorkers& workers,
                              const std::vector<std::string>& inputs);

/// Throws the Error of the members of a plan that failed, with the exit code of the first; does nothing where
/// none has. `consequence`: "left out of the means".
void refuse_failures(const ensemble::EnsemblePlan& plan, const std::string& consequence);

/// Prints that a worker leaves a member for later, and who writes its run.
void tell_wait(const std::string& member, const std::string& writer);

}  // namespace talus::app
