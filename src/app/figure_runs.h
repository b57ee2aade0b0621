#pragma once
/// Runs opened and analysed, for figures.

#include <string>
#include <vector>

#include "app/analysed_run.h"
#include "figures/run_group.h"

namespace talus {

/// `paths`, with each folder of an ensemble replaced by the runs of its members that are done. Throws
/// Error(missing_input) where there is none in it yet, and as read_ensemble does.
std::vector<std::string> runs_named(const std::vector<std::string>& paths);

/// The runs at `paths`, in that order. Throws as analysed_run does.
std::vector<FigureRun> open_figure_runs(const std::vector<std::string>& paths,
                                        const AnalysisParameters& parameters, const AnalysisOptions& options);

}  // namespace talus
