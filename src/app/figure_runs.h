#pragma once
/// Runs opened and analysed, for figures, and the values of members of ensembles.

#include <string>
#include <vector>

#include "figures/run_group.h"
#include "runs/run_view.h"

namespace talus::app {

/// The runs at `paths`, in that order. Throws as analysed_run does.
std::vector<runs::RunView> open_figure_runs(const std::vector<std::string>& paths,
                                            const analysis::AnalysisParameters& parameters,
                                            const runs::AnalysisOptions& options);

/// What the arguments of `talus figures` stand for.
struct FigureInput {
  std::vector<runs::RunView> runs;
  std::vector<std::string> files;  ///< files and folders that were read, and must not be replaced
};

/// Each of `paths` is a run; a folder of an ensemble, for its members that are done; or an ensemble.h5, or a
/// folder that has one, for the values in it. `settings` change the analysis, which only runs can have made
/// anew. Throws Error(missing_input) where an ensemble has no member that is done, Error(usage) where there
/// are settings and no runs to analyse, and as analysed_run, read_ensemble and read_averages do.
FigureInput read_figure_input(const std::vector<std::string>& paths, const std::vector<std::string>& settings,
                              const runs::AnalysisOptions& options);

}  // namespace talus::app
