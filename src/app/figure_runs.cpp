#include "app/figure_runs.h"

#include "session/run_header.h"

namespace talus {

std::vector<FigureRun> open_figure_runs(const std::vector<std::string>& paths,
                                        const AnalysisParameters& parameters,
                                        const AnalysisOptions& options) {
  std::vector<FigureRun> runs;
  for (const std::string& path : paths) {
    // The analysis comes first: storing it replaces the file.
    Analysis analysis = analysed_run(path, parameters, options).analysis;
    RunFile file = RunFile::open(path);
    const Scenario scenario = stored_scenario(file.header(), path);
    runs.push_back({path, std::move(file), std::move(analysis), scenario});
  }
  return runs;
}

}  // namespace talus
