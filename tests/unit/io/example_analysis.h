#pragma once
/// Analysis with a different value in every element, for the example run.

#include "analysis/record.h"
#include "unit/io/example_run.h"

namespace talus::example {

/// Commits of the associated run: 3 frames.
inline constexpr int analysis_commits = 3;

/// Returns the state hash of the run after these commits.
std::string analysed_state();

/// Returns an analysis with `thresholds` thresholds; each `serial` gives different values.
analysis::Analysis analysis(std::uint64_t thresholds, int serial);

}  // namespace talus::example
