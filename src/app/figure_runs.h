#pragma once
/// Runs opened and analysed for figures, and values of ensemble members.

#include <string>
#include <vector>

#include "figures/run_group.h"
#include "runs/run_view.h"

namespace talus::app {

/// Opens and analyses the runs at `paths`, in that order. Throws as analysed_run does.
std::vector<runs::RunView> open_figure_runs(const std::vector<std::string>& paths,
                                            const analysis::AnalysisParameters& parameters,
                                            const runs::AnalysisOptions& options);

/// The input that the arguments of `talus figures` denote.
struct FigureInput {
  std::vector<runs::RunView> runs;
  std::vector<std::string> files;  ///< files and folders that were read and must not be replaced
};

/// Reads each of `paths`: a run; the folder of an ensemble, for its finished members; or an ensemble.h5, or a
/// folder with one, for the values in it. `settings` change the analysis, which can be recomputed only for
/// runs. Throws Error(missing_input) if an ensemble has no finished member, Error(usage) if settings are
/// given without runs to analyse, and as analysed_run, read_ensemble and read_averages do.
FigureInput read_figure_input(const std::vector<std::string>& paths, const std::vector<std::string>& settings,
                              const runs::AnalysisOptions& options);

}  // namespace talus::app
