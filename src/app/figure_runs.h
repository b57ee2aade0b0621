#pragma once
/// Runs opened and analysed, for figures.

#include <string>
#include <vector>

#include "app/analysed_run.h"
#include "figures/run_group.h"

namespace talus {

/// The runs at `paths`, in that order. Throws as analysed_run does.
std::vector<FigureRun> open_figure_runs(const std::vector<std::string>& paths,
                                        const AnalysisParameters& parameters, const AnalysisOptions& options);

}  // namespace talus
