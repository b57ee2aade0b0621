#pragma once
/// What is said of an ensemble: how far it is, and what its members gave.

#include <cstddef>
#include <string>
#include <vector>

#include "app/ensemble_jobs.h"
#include "ensemble/ensemble_manifest.h"
#include "ensemble/member_reader.h"
#include "ensemble/member_state.h"

namespace talus::app {

/// An ensemble as it is now.
struct EnsembleView {
  std::string folder;
  ensemble::EnsembleManifest manifest;
  ensemble::EnsemblePlan plan;
  std::vector<ensemble::MemberState> states;     ///< of the members of the plan
  std::vector<ensemble::MemberNumbers> numbers;  ///< of those that are done; of the others nothing
  std::size_t with_frames = 0;                   ///< members that are done and have the frames of their runs
};

/// Members whose files are damaged wait. Throws as read_ensemble and numbers_of do.
EnsembleView view_of_ensemble(const std::string& folder, ensemble::KnownMembers& known);

/// Members that will not be begun any more: done, failed, or not needed for the precision that was asked for.
std::size_t count_ended(const EnsembleView& view);

/// "12 of 50 done, 2 under way, 1 failed"
std::string count_text(const EnsembleView& view);

/// That, who is at work, the jobs in the queue, what failed, and the means of each variant with their errors.
std::string ensemble_text(const EnsembleView& view, const EnsembleJobs& jobs = {});
std::string ensemble_json(const EnsembleView& view, const EnsembleJobs& jobs = {});

/// One row for each member that is done: variant, seed, hash, version, seconds, and all its numbers, with
/// their units in the names of the columns.
std::string members_csv(const EnsembleView& view);

}  // namespace talus::app
