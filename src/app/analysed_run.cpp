#include "app/analysed_run.h"

#include "app/count_progress.h"
#include "core/hash.h"
#include "io/analysis_file.h"
#include "io/run_file.h"
#include "session/analysis_run.h"

namespace talus {

AnalysedRun analysed_run(const std::string& path, const AnalysisParameters& parameters,
                         const AnalysisOptions& options) {
  const RunFile run = RunFile::open(path);
  AnalysedRun result{path, "", run.header().statics, {}};
  if (run.complete() && !options.force)
    if (auto stored = read_analysis(path); stored && stored->key == analysis_key(run, parameters)) {
      result.state = "analysis read from the file";
      result.analysis = std::move(*stored);
      return result;
    }
  CountProgress line("analysis", run.frame_count(), options.quiet);
  result.analysis =
      analyse_run(run, parameters, options.threads, [&line](std::size_t done) { line.show(done); });
  result.state = "analysis stored in the file";
  if (run.complete())
    store_analysis(path, result.analysis, hash_text(state_hash(run.checkpoint().world)));
  else
    result.state = "analysis not stored: the run is not complete";
  return result;
}

}  // namespace talus
