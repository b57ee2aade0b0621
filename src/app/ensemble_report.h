#pragma once
/// Reports of an ensemble: its progress, the results of its members, and their averages.

#include <cstddef>
#include <string>
#include <vector>

#include "app/ensemble_submit.h"
#include "ensemble/ensemble_manifest.h"
#include "ensemble/member_results.h"

namespace talus::app {

/// Snapshot of an ensemble.
struct EnsembleView {
  std::string folder;
  ensemble::EnsembleManifest manifest;
  ensemble::EnsemblePlan plan;
  std::vector<ensemble::MemberState> states;     ///< one for each member of the plan
  std::vector<ensemble::MemberNumbers> numbers;  ///< results of finished members; empty for the others
  std::size_t with_frames = 0;                   ///< finished members that keep the frames of their runs
};

/// Reads the state of an ensemble; damaged members count as waiting. Throws as read_ensemble and numbers_of.
EnsembleView view_of_ensemble(const std::string& folder, ensemble::KnownMembers& known);

/// Returns the number of members that will not be started: done, failed, or not needed.
std::size_t count_ended(const EnsembleView& view);

/// Returns "12 of 50 done, 2 under way, 1 failed".
std::string count_text(const EnsembleView& view);

/// Returns the counts, the active workers, the jobs, the failures, and the means of each variant with errors.
std::string ensemble_text(const EnsembleView& view, const EnsembleJobs& jobs = {});
std::string ensemble_json(const EnsembleView& view, const EnsembleJobs& jobs = {});

/// Writes members.csv, averages.csv and ensemble.h5 for the members that are done into the folder of the
/// ensemble, and returns its progress; writes nothing if no member is done. Runs without an analysis are
/// analysed. Processes take turns, so that the files reflect the latest state. Throws as read_ensemble and
/// analysed_member do.
EnsembleView write_averages(const std::string& folder, ensemble::KnownMembers& known);

}  // namespace talus::app
