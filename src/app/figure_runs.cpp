#include "app/figure_runs.h"

#include <cstdio>

#include "core/visible_text.h"
#include "session/run_header.h"

namespace talus {

std::vector<FigureRun> open_figure_runs(const std::vector<std::string>& paths,
                                        const AnalysisParameters& parameters,
                                        const AnalysisOptions& options) {
  std::vector<FigureRun> runs;
  for (const std::string& path : paths) {
    // The analysis comes first: storing it replaces the file.
    AnalysedRun run = analysed_run(path, parameters, options);
    if (!run.is_kept && !options.quiet)
      std::fprintf(stderr, "talus: note: %s: %s\n", path.c_str(), visible(run.state).c_str());
    RunFile file = RunFile::open(path);
    const Scenario scenario = stored_scenario(file.header(), path);
    runs.push_back({path, std::move(file), std::move(run.analysis), scenario});
  }
  return runs;
}

}  // namespace talus
