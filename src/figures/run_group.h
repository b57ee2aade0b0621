#pragma once
/// The runs that figures are made from, those of one scenario together.

#include <string>
#include <vector>

#include "runs/run_view.h"

namespace talus::figures {

/// Runs that differ in their seed and in nothing else that shapes the result: an ensemble.
struct RunGroup {
  /// "PBC, L = 200 D", with the keys that tell it from another group of that bed, or else its folder.
  std::string label;
  std::vector<runs::RunView> runs;  ///< by ascending seed

  bool periodic() const { return runs.front().scenario.bed.boundary == scenario::BedBoundary::periodic; }
};

/// Groups in the order of their first run: of periodic beds first, then of beds between walls by their
/// length. Runs of one scenario and seed that ended in other states are of two groups. Throws Error(bad_data)
/// where a run is there twice.
std::vector<RunGroup> group_runs(std::vector<runs::RunView> runs);

}  // namespace talus::figures
