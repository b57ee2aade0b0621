#include "ensemble/reproduction_values.h"

#include <filesystem>
#include <optional>

#include "core/errors.h"
#include "ensemble/measured_file.h"
#include "io/analysis_file.h"
#include "io/durable_file.h"
#include "io/run_file.h"
#include "session/analysis_parameters.h"
#include "session/analysis_run.h"
#include "session/run_header.h"

namespace talus {
namespace {

namespace fs = std::filesystem;

constexpr double seconds_of_grain_frame = 1.2e-5;  // of an analysis, on one thread

double estimated_seconds(const RunFile& run) {
  return seconds_of_grain_frame * static_cast<double>(run.frame_count()) *
         static_cast<double>(run.header().statics.free_count);
}

/// The stored analysis where it is the one with default parameters.
std::optional<Analysis> stored_analysis(const std::string& path) {
  std::optional<Analysis> stored = read_analysis(path);
  if (stored && stored->key != analysis_key(RunFile::open(path), AnalysisParameters())) stored.reset();
  return stored;
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

/// An analysis that no run file stores: of one run with one change.
struct KeptAnalysis {
  std::string run;   ///< its path
  std::string file;  ///< of its values
  AnalysisParameters parameters;
};

KeptAnalysis kept_analysis(const Member& member, const ChainAnalysis& analysis, const std::string& folder) {
  const fs::path file = fs::path(folder) / "study" / member.name / (analysis.name + ".csv");
  return {member.path, file.string(), parse_analysis_settings(analysis.settings)};
}

std::optional<std::vector<MeasuredValues>> kept_values(const KeptAnalysis& kept) {
  if (!fs::exists(kept.file)) return std::nullopt;
  return parse_measured(read_text(kept.file), analysis_key(RunFile::open(kept.run), kept.parameters));
}

/// Of all runs of periodic beds.
std::vector<KeptAnalysis> kept_analyses(const ReproductionPlan& plan, const std::string& folder) {
  std::vector<KeptAnalysis> all;
  for (const std::size_t m : complete_members(plan)) {
    const Member& member = plan.members[m];
    if (!is_periodic(plan.variants[member.variant])) continue;
    for (const ChainAnalysis& analysis : chain_analyses(member.scenario.bed.depth))
      if (!analysis.settings.empty()) all.push_back(kept_analysis(member, analysis, folder));
  }
  return all;
}

void make_missing(const std::vector<KeptAnalysis>& all, const ValueOptions& options) {
  std::vector<const KeptAnalysis*> missing;
  for (const KeptAnalysis& kept : all)
    if (!kept_values(kept)) missing.push_back(&kept);
  for (std::size_t k = 0; k < missing.size(); ++k) {
    const KeptAnalysis& kept = *missing[k];
    const RunFile run = RunFile::open(kept.run);
    const Analysis analysis = analyse_run(run, kept.parameters, options.threads, [&](std::size_t) {
      options.keep_on();
      options.show(k, missing.size());
    });
    prepare_folder_of(kept.file);
    write_text(kept.file,
               measured_text(analysis.key, measure_thresholds(run, analysis, Population::carrying)));
    options.show(k + 1, missing.size());
  }
}

ReproducedOutcome measure_run(const ReproductionPlan& plan, std::size_t m, const std::string& folder) {
  const Member& member = plan.members[m];
  const RunFile run = RunFile::open(member.path);
  const auto stored = stored_analysis(member.path);
  if (!stored) throw Error(ExitCode::internal, member.path + ": its analysis has disappeared");
  ReproducedOutcome outcome{m, version_of(run.header().provenance), 0.0, {}, {}};
  for (const auto& [name, seconds] : run.checkpoint().timing)
    if (name == "deposition" || name == "tilt") outcome.seconds += seconds;
  const std::vector<ObservableRow> rows = run.observables();
  const RunStatics& statics = run.header().statics;
  outcome.wall = wall_point({run.frame_tilts(), rows, statics.mean_diameter, *stored}, statics.length);
  for (const ChainAnalysis& analysis : chain_analyses(member.scenario.bed.depth))
    if (analysis.settings.empty())
      outcome.values.push_back(measure_thresholds(run, *stored, analysis.population));
    else if (is_periodic(plan.variants[member.variant]))
      outcome.values.push_back(kept_values(kept_analysis(member, analysis, folder)).value());
    else
      outcome.values.emplace_back();
  return outcome;
}

}  // namespace

std::vector<Job> missing_analyses(const ReproductionPlan& plan) {
  std::vector<Job> jobs;
  for (const std::size_t m : complete_members(plan)) {
    const Member& member = plan.members[m];
    if (stored_analysis(member.path)) continue;
    jobs.push_back(job_of(member, {"analyze", path_word(member.path), "--threads", "1", "--quiet"}));
    jobs.back().estimate = estimated_seconds(RunFile::open(member.path));
  }
  return jobs;
}

ReproductionResult measure_runs(const ReproductionPlan& plan, const ValueOptions& options) {
  make_missing(kept_analyses(plan, options.folder), options);
  ReproductionResult result{plan, {}};
  for (const std::size_t m : complete_members(plan)) {
    options.keep_on();
    result.outcomes.push_back(measure_run(plan, m, options.folder));
  }
  return result;
}

}  // namespace talus
