#include "runs/run_view.h"

#include <fmt/core.h>

#include "base/hash.h"
#include "base/output_file.h"
#include "io/packed_file.h"
#include "runs/analysis_run.h"

namespace talus::runs {

scenario::Scenario stored_scenario(const io::RunHeader& header, const std::string& name) {
  return scenario::parse_scenario(header.scenario_resolved, name);
}

std::string version_of(const Facts& provenance) {
  return fmt::format("{} ({})", find_value(provenance, "version").value_or("unknown"),
                     find_value(provenance, "git_hash").value_or("unknown"));
}

RunView view_of_run(const std::string& path, io::RunFile file, analysis::Analysis analysis) {
  RunView run;
  run.path = path;
  run.file = std::move(file);
  run.analysis = std::move(analysis);
  const io::RunHeader& header = run.file->header();
  const io::Checkpoint& end = run.file->checkpoint();
  run.statics = header.statics;
  run.scenario = stored_scenario(header, path);
  run.scenario_text = header.scenario_resolved;
  run.state_hash = hash_text(state_hash(end.world));
  run.theta_r = find_value(end.results, "theta_r").value_or(not_known);
  return run;
}

RunView analysed_run(const std::string& path, const analysis::AnalysisParameters& parameters,
                     const AnalysisOptions& options) {
  io::RunFile run = io::RunFile::open(path);
  if (run.complete() && !options.force)
    if (auto stored = io::read_analysis(run); stored && stored->key == analysis_key(run, parameters)) {
      RunView view = view_of_run(path, std::move(run), std::move(*stored));
      view.kept = "analysis read from the file";
      view.is_kept = true;
      return view;
    }
  const std::size_t count = run.frame_count();
  const auto progress = [&](std::size_t done) {
    if (options.progress) options.progress(done, count);
  };
  analysis::Analysis analysis = analyse_run(run, parameters, options.threads, progress);
  // Without write permission the analysis is not stored.
  const std::string reason = run.complete() ? protection_of(path) : "the run is not complete";
  if (reason.empty()) {
    io::store_analysis(path, analysis, hash_text(state_hash(run.checkpoint().world)));
    run = io::RunFile::open(path);  // storing replaces the file
  }
  RunView view = view_of_run(path, std::move(run), std::move(analysis));
  view.is_kept = reason.empty();
  view.kept = reason.empty() ? "analysis stored in the file" : "analysis not stored: " + reason;
  return view;
}

}  // namespace talus::runs
