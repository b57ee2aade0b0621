#pragma once
/// An analysis with a value of its own in every element, for the example run.

#include "analysis/record.h"
#include "unit/io/example_run.h"

namespace talus::example {

/// Commits of the run that it belongs to: 3 frames.
inline constexpr int analysis_commits = 3;

/// Of the run after these commits.
std::string analysed_state();

/// For `thresholds` thresholds. Analyses of another `serial` have other values.
analysis::Analysis analysis(std::uint64_t thresholds, int serial);

}  // namespace talus::example
