#include "app/figure_runs.h"

#include <cstdio>
#include <filesystem>
#include <fmt/core.h>

#include "app/given_runs.h"
#include "app/output_files.h"
#include "app/terminal.h"
#include "core/errors.h"
#include "core/paths.h"
#include "core/visible_text.h"
#include "ensemble/averages_reader.h"
#include "ensemble/ensemble_manifest.h"
#include "ensemble/kept_runs.h"
#include "ensemble/member_analysis.h"
#include "ensemble/member_lists.h"
#include "ensemble/member_state.h"
#include "ensemble/pool.h"
#include "io/durable_file.h"
#include "io/run_store.h"
#include "runs/analysis_parameters.h"

namespace talus {
namespace {

namespace fs = std::filesystem;

/// What is read so far, and how runs are to be analysed.
struct Reading {
  const std::vector<std::string>& settings;
  AnalysisParameters parameters;
  const AnalysisOptions& options;
  FigureInput input = {};
};

RunView open_run(const std::string& path, const AnalysisParameters& parameters,
                 const AnalysisOptions& options) {
  RunView run = analysed_run(path, parameters, options);
  if (!run.is_kept && options.progress) print_error("talus: note: %s: %s\n", path.c_str(), run.kept.c_str());
  return run;
}

void add_run(Reading& reading, const std::string& path) {
  reading.input.runs.push_back(open_run(path, reading.parameters, reading.options));
  for (const std::string& file : output_of_run(path, false).inputs) reading.input.files.push_back(file);
}

/// Values come from an analysis that was made.
void refuse_settings(const Reading& reading, const std::string& path) {
  if (reading.settings.empty()) return;
  throw Error(ExitCode::usage,
              fmt::format("--set {}: {} has the values of an analysis that was made with the default "
                          "parameters, and no run that could be analysed with others",
                          visible_word(reading.settings.front()), path));
}

/// A member whose run is gone, from its tables.
void add_tables(Reading& reading, const Member& member, const Variant& variant) {
  const std::string numbers = numbers_path(member.path), series = series_path(member.path);
  refuse_settings(reading, numbers);
  if (!is_there(series)) refuse_missing_series(member);
  const MemberNumbers found = read_numbers(member);
  require_own_file(member, found, series_ending);
  reading.input.runs.push_back(view_of_values(numbers,
                                              {member.seed, found, parse_series(read_text(series), series)},
                                              read_text(variant.scenario_file)));
  reading.input.files.insert(reading.input.files.end(), {numbers, series});
  const std::string lists = lists_path(member.path);
  if (!is_there(lists)) return;
  require_own_file(member, found, lists_ending);
  RunView& run = reading.input.runs.back();
  set_lists(read_lists(lists), run.statics.mean_diameter, run.analysis);
  reading.input.files.push_back(lists);
}

void add_ensemble(Reading& reading, const std::string& folder) {
  const EnsemblePlan plan = plan_of(read_ensemble(folder), folder);
  const std::vector<MemberState> states = look_at_members(plan);
  if (count_of(states, MemberStage::done) == 0)
    throw Error(ExitCode::missing_input,
                fmt::format("{}: no member of this ensemble is done yet; talus ensemble status {} tells how "
                            "far they are",
                            folder, folder));
  for (std::size_t m = 0; m < states.size(); ++m) {
    const Member& member = plan.members[m];
    if (states[m].stage != MemberStage::done) continue;
    if (run_presence(member.path) == RunPresence::none) {
      add_tables(reading, member, plan.variants[member.variant]);
    } else {
      is_complete(member);  // its own run
      add_run(reading, member.path);
    }
  }
}

void add_values(Reading& reading, const std::string& path) {
  refuse_settings(reading, path);
  for (const StoredVariant& variant : read_averages(path))
    for (std::size_t m = 0; m < variant.seeds.size(); ++m)
      reading.input.runs.push_back(
          view_of_values(fmt::format("{}#{}{}seed-{}", path, variant.name, variant.name.empty() ? "" : "/",
                                     variant.seeds[m]),
                         member_of(variant, m), variant.scenario));
  reading.input.files.push_back(path);
}

}  // namespace

std::vector<RunView> open_figure_runs(const std::vector<std::string>& paths,
                                      const AnalysisParameters& parameters, const AnalysisOptions& options) {
  std::vector<RunView> runs;
  for (const std::string& path : paths) runs.push_back(open_run(path, parameters, options));
  return runs;
}

FigureInput read_figure_input(const std::vector<std::string>& paths, const std::vector<std::string>& settings,
                              const AnalysisOptions& options) {
  Reading reading{settings, parse_analysis_settings(settings), options};
  for (const std::string& path : runs_among(paths, holds_averages)) {
    const std::string averages = (fs::path(path) / "ensemble.h5").string();
    if (is_ensemble(path))
      add_ensemble(reading, path);
    else if (holds_averages(path))
      add_values(reading, path);
    else if (is_there(averages))
      add_values(reading, averages);
    else
      add_run(reading, path);
  }
  return std::move(reading.input);
}

}  // namespace talus
