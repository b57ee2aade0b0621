#pragma once
/// Runs for figures, grouped by scenario.

#include <string>
#include <vector>

#include "runs/run_view.h"

namespace talus::figures {

/// An ensemble: runs that differ only in their seed and in settings without effect on the result. Commands
/// and the start of a branch have an effect.
struct RunGroup {
  /// "PBC, L = 200 D", followed by the keys that distinguish it from another group of that bed, or by its
  /// folder.
  std::string label;
  std::vector<runs::RunView> runs;  ///< ascending in seed
  /// What was done to the runs that their scenario does not say (session::departures), and the version of
  /// Talus that computed them, if it is another.
  std::vector<std::string> departures = {};

  bool periodic() const { return runs.front().scenario.bed.boundary == scenario::BedBoundary::periodic; }
};

/// Groups runs in the order of their first run: periodic beds first, then beds between walls by length. Runs
/// of the same scenario and seed with different final states belong to two groups. Throws Error(bad_data) if
/// a run occurs twice.
std::vector<RunGroup> group_runs(std::vector<runs::RunView> runs);

}  // namespace talus::figures
