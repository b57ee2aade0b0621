#include "app/reproduction_values.h"

#include <filesystem>
#include <optional>
#include <span>

#include "app/missing_runs.h"
#include "core/errors.h"
#include "io/analysis_file.h"
#include "io/durable_file.h"
#include "io/run_file.h"
#include "reproduction/measured_file.h"
#include "session/analysis_run.h"
#include "session/study_result.h"

namespace talus {
namespace {

namespace fs = std::filesystem;

constexpr double seconds_of_grain_frame = 1.2e-5;  // of an analysis, on one thread

double estimated_seconds(const RunFile& run) {
  return seconds_of_grain_frame * static_cast<double>(run.frame_count()) *
         static_cast<double>(run.header().statics.free_count);
}

std::vector<std::size_t> complete_runs(const ReproductionPlan& plan, const WorkOptions& options) {
  std::vector<std::size_t> complete;
  for (std::size_t r = 0; r < plan.runs.size(); ++r)
    if (run_presence(run_path(options, plan.runs[r])) == RunPresence::packed) complete.push_back(r);
  return complete;
}

/// The stored analysis where it is that of the plan.
std::optional<Analysis> stored_analysis(const std::string& path, const AnalysisParameters& parameters) {
  std::optional<Analysis> stored = read_analysis(path);
  if (stored && stored->key != analysis_key(RunFile::open(path), parameters)) stored.reset();
  return stored;
}

ChildRun analysis_child(const std::string& path) {
  ChildRun child{{"analyze", path, "--threads", "1", "--quiet"},
                 fs::path(path).replace_extension(".log").string()};
  return child;
}

std::vector<MeasuredValues> measure_thresholds(const RunFile& run, const Analysis& analysis,
                                               Population population) {
  const std::vector<ObservableRow> rows = run.observables();
  const MeasuredRun measured{run.frame_tilts(), rows, run.header().statics.mean_diameter, analysis};
  std::vector<MeasuredValues> thresholds;
  for (std::size_t f = 0; f < AnalysisParameters().threshold_factors.size(); ++f)
    thresholds.push_back(measure_all(measured, f, population));
  return thresholds;
}

std::string text_of(const std::string& path) {
  if (!fs::exists(path)) return "";
  const std::vector<std::byte> bytes = read_file(path);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// The analyses of the study that no run file stores.
std::vector<StudyAnalysis> kept_analyses(const ReproducedRun& run) {
  std::vector<StudyAnalysis> analyses = study_analyses(run.scenario.bed.depth);
  analyses.erase(analyses.begin());
  return analyses;
}

/// An analysis of the study: of one run with one change.
struct StudyTask {
  std::string run;      ///< its path
  std::string name;     ///< "pbc/seed-1/min_contacts=3"
  std::string kept_in;  ///< the file of its values
  AnalysisParameters parameters;
};

StudyTask study_task(const WorkOptions& options, const ReproducedRun& run, const StudyAnalysis& analysis) {
  const std::string name = run.name + "/" + analysis.name;
  return {run_path(options, run), name, (fs::path(options.folder) / "study" / (name + ".csv")).string(),
          parse_analysis_settings(analysis.settings)};
}

std::optional<std::vector<MeasuredValues>> kept_values(const StudyTask& task) {
  return parse_measured(text_of(task.kept_in), analysis_key(RunFile::open(task.run), task.parameters));
}

/// Analyses and keeps the values.
void carry_out(const StudyTask& task, const WorkOptions& options, const RunsProgress& progress) {
  const RunFile run = RunFile::open(task.run);
  const Analysis analysis = analyse_run(run, task.parameters, options.jobs, [&](std::size_t) {
    stop_where_asked(options);
    progress.show();
  });
  const std::string text =
      measured_text(analysis.key, measure_thresholds(run, analysis, Population::carrying));
  make_folders(parent_folder(task.kept_in));
  write_durably(task.kept_in, std::as_bytes(std::span(text)), task.kept_in + ".part");
}

/// Of all runs of periodic beds.
std::vector<StudyTask> study_tasks(const ReproductionPlan& plan, const WorkOptions& options) {
  std::vector<StudyTask> tasks;
  for (const std::size_t r : complete_runs(plan, options)) {
    const ReproducedRun& run = plan.runs[r];
    if (!plan.beds[run.bed].periodic()) continue;
    for (const StudyAnalysis& analysis : kept_analyses(run))
      tasks.push_back(study_task(options, run, analysis));
  }
  return tasks;
}

void carry_out_missing(const std::vector<StudyTask>& tasks, const WorkOptions& options) {
  std::vector<const StudyTask*> missing;
  std::vector<AwaitedRun> awaited;
  for (const StudyTask& task : tasks)
    if (!kept_values(task)) {
      missing.push_back(&task);
      awaited.push_back({task.name, estimated_seconds(RunFile::open(task.run)) / options.jobs});
    }
  if (missing.empty()) return;
  RunsProgress progress({"threshold", "analyses"}, std::move(awaited), tasks.size() - missing.size(), 1);
  for (std::size_t k = 0; k < missing.size(); ++k) {
    progress.start(k);
    carry_out(*missing[k], options, progress);
    progress.end(k, 0);
  }
  progress.show();
  progress.finish();
}

ReproducedOutcome measure_run(const ReproductionPlan& plan, const WorkOptions& options, std::size_t r) {
  const ReproducedRun& planned = plan.runs[r];
  const std::string path = run_path(options, planned);
  const RunFile run = RunFile::open(path);
  const auto analysis = stored_analysis(path, AnalysisParameters());
  if (!analysis) throw Error(ExitCode::internal, path + ": its analysis has gone");
  ReproducedOutcome outcome;
  outcome.run = r;
  outcome.version = version_of(run.header().provenance);
  for (const auto& [name, seconds] : run.checkpoint().timing)
    if (name == "deposition" || name == "tilt") outcome.seconds += seconds;
  outcome.values.push_back(measure_thresholds(run, *analysis, Population::carrying));
  const std::vector<ObservableRow> rows = run.observables();
  const RunStatics& statics = run.header().statics;
  outcome.wall = wall_point({run.frame_tilts(), rows, statics.mean_diameter, *analysis}, statics.length);
  outcome.values_of_all = measure_thresholds(run, *analysis, Population::all);
  if (plan.beds[planned.bed].periodic())
    for (const StudyAnalysis& each : kept_analyses(planned))
      outcome.values.push_back(kept_values(study_task(options, planned, each)).value());
  return outcome;
}

}  // namespace

void stop_where_asked(const WorkOptions& options) {
  if (*options.stop != 0)
    throw Error(ExitCode::stopped, "the reproduction was stopped; the same command goes on with it");
}

std::string run_path(const WorkOptions& options, const ReproducedRun& run) {
  return (fs::path(options.folder) / "runs" / (run.name + ".h5")).string();
}

void analyse_missing(const ReproductionPlan& plan, const WorkOptions& options) {
  const AnalysisParameters parameters = AnalysisParameters();
  std::vector<ChildRun> children;
  std::vector<AwaitedRun> awaited;
  const std::vector<std::size_t> complete = complete_runs(plan, options);
  for (const std::size_t r : complete) {
    stop_where_asked(options);
    const std::string path = run_path(options, plan.runs[r]);
    if (stored_analysis(path, parameters)) continue;
    children.push_back(analysis_child(path));
    awaited.push_back({plan.runs[r].name, estimated_seconds(RunFile::open(path))});
  }
  const std::size_t kept = complete.size() - children.size();
  const std::vector<FailedRun> failed = run_with_progress(
      children, {"analysis", "analyses"}, std::move(awaited), kept, options.jobs, "reproduction");
  if (!failed.empty()) refuse(failed, "nothing is compared without their analysis");
}

ReproductionResult measure_runs(const ReproductionPlan& plan, const WorkOptions& options) {
  carry_out_missing(study_tasks(plan, options), options);
  ReproductionResult result{plan, {}};
  for (const std::size_t r : complete_runs(plan, options)) {
    stop_where_asked(options);
    result.outcomes.push_back(measure_run(plan, options, r));
  }
  return result;
}

}  // namespace talus
