#include "app/figure_runs.h"

#include <cstdio>
#include <filesystem>
#include <fmt/core.h>

#include "app/given_runs.h"
#include "app/output_files.h"
#include "app/terminal.h"
#include "base/errors.h"
#include "base/paths.h"
#include "base/visible_text.h"
#include "ensemble/averages_reader.h"
#include "ensemble/ensemble_manifest.h"
#include "ensemble/member_reader.h"
#include "ensemble/member_state.h"
#include "runs/analysis_parameters.h"

namespace talus::app {
namespace {

namespace fs = std::filesystem;

/// Input read so far, and the parameters of the analysis.
struct Reading {
  const std::vector<std::string>& settings;
  analysis::AnalysisParameters parameters;
  const runs::AnalysisOptions& options;
  FigureInput input = {};
};

runs::RunView open_run(const std::string& path, const analysis::AnalysisParameters& parameters,
                       const runs::AnalysisOptions& options) {
  runs::RunView run = runs::analysed_run(path, parameters, options);
  if (!run.is_kept && options.progress) print_error("talus: note: %s: %s\n", path.c_str(), run.kept.c_str());
  return run;
}

void add_run(Reading& reading, const std::string& path) {
  reading.input.runs.push_back(open_run(path, reading.parameters, reading.options));
  for (const std::string& file : output_of_run(path, false).inputs) reading.input.files.push_back(file);
}

/// Rejects settings for stored values, whose analysis cannot be changed.
void refuse_settings(const Reading& reading, const std::string& path) {
  if (reading.settings.empty()) return;
  throw Error(ExitCode::usage, fmt::format("--set {}: {} holds values of an analysis with the default "
                                           "parameters, and no run that could be analysed with others",
                                           visible_word(reading.settings.front()), path));
}

void add_ensemble(Reading& reading, const std::string& folder) {
  for (const ensemble::Member& member : done_members(folder)) {
    add_run(reading, member.path);
    ensemble::require_own_run(member, *reading.input.runs.back().file);
  }
}

void add_values(Reading& reading, const std::string& path) {
  refuse_settings(reading, path);
  for (const ensemble::StoredVariant& variant : ensemble::read_averages(path))
    for (std::size_t m = 0; m < variant.seeds.size(); ++m)
      reading.input.runs.push_back(ensemble::view_of_values(path, variant, m));
  reading.input.files.push_back(path);
}

}  // namespace

std::vector<runs::RunView> open_figure_runs(const std::vector<std::string>& paths,
                                            const analysis::AnalysisParameters& parameters,
                                            const runs::AnalysisOptions& options) {
  std::vector<runs::RunView> runs;
  for (const std::string& path : paths) runs.push_back(open_run(path, parameters, options));
  return runs;
}

FigureInput read_figure_input(const std::vector<std::string>& paths, const std::vector<std::string>& settings,
                              const runs::AnalysisOptions& options) {
  Reading reading{settings, runs::parse_analysis_settings(settings), options};
  for (const std::string& path : runs_among(paths, ensemble::holds_averages)) {
    const std::string averages = (fs::path(path) / "ensemble.h5").string();
    if (ensemble::is_ensemble(path))
      add_ensemble(reading, path);
    else if (ensemble::holds_averages(path))
      add_values(reading, path);
    else if (is_there(averages))
      add_values(reading, averages);
    else
      add_run(reading, path);
  }
  return std::move(reading.input);
}

}  // namespace talus::app
