#include "app/analysed_run.h"

#include "app/progress.h"
#include "core/hash.h"
#include "core/output_file.h"
#include "io/analysis_file.h"
#include "io/run_file.h"
#include "session/analysis_run.h"

namespace talus {

AnalysedRun analysed_run(const std::string& path, const AnalysisParameters& parameters,
                         const AnalysisOptions& options) {
  const RunFile run = RunFile::open(path);
  AnalysedRun result{path, "", false, run.header().statics, {}};
  if (run.complete() && !options.force)
    if (auto stored = read_analysis(path); stored && stored->key == analysis_key(run, parameters)) {
      result.state = "analysis read from the file";
      result.is_kept = true;
      result.analysis = std::move(*stored);
      return result;
    }
  const CountDone progress = count_shown("analysis", options.quiet);
  progress(0, run.frame_count());
  result.analysis = analyse_run(run, parameters, options.threads,
                                [&](std::size_t done) { progress(done, run.frame_count()); });
  // Who may not write here reads all the same.
  const std::string reason = run.complete() ? protection_of(path) : "the run is not complete";
  if (reason.empty()) store_analysis(path, result.analysis, hash_text(state_hash(run.checkpoint().world)));
  result.is_kept = reason.empty();
  result.state = reason.empty() ? "analysis stored in the file" : "analysis not stored: " + reason;
  return result;
}

}  // namespace talus
