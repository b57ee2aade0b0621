/// `talus analyze`: multiscale analysis of complete runs, printed and stored in their files.

#include <cstdio>
#include <memory>

#include "app/analysis_report.h"
#include "app/choices.h"
#include "app/commands.h"
#include "app/given_runs.h"
#include "app/progress.h"
#include "app/terminal.h"
#include "runs/analysis_parameters.h"

namespace talus::app {
namespace {

struct AnalyzeArguments {
  std::vector<std::string> runs;
  std::vector<std::string> settings;
  runs::AnalysisOptions options;
  bool json = false;
  bool quiet = false;
};

void analyze(const AnalyzeArguments& arguments) {
  const analysis::AnalysisParameters parameters = runs::parse_analysis_settings(arguments.settings);
  const std::vector<std::string> runs = with_members(runs_among(arguments.runs));
  runs::AnalysisOptions options = arguments.options;
  options.progress = count_shown("analysis", arguments.quiet);
  if (arguments.json) print("[");
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const runs::RunView run = runs::analysed_run(runs[r], parameters, options);
    if (arguments.json)
      print("%s%s", r > 0 ? ",\n" : "", analysis_json(run).c_str());
    else
      print("%s%s", r > 0 ? "\n" : "", analysis_text(run).c_str());
    std::fflush(stdout);
  }
  if (arguments.json) print("]\n");
}

}  // namespace

void add_analyze_command(CLI::App& app) {
  auto arguments = std::make_shared<AnalyzeArguments>();
  CLI::App* command = app.add_subcommand(
      "analyze",
      "Analyse stresses, overloaded grains and contacts of runs, and store the results in their files");
  command
      ->add_option(
          "RUNS", arguments->runs,
          "Run files, or folders of ensembles; the analysis of an incomplete run is printed but not stored")
      ->required();
  command
      ->add_option("--set", arguments->settings,
                   "Change a parameter of the analysis, e.g. --set lc_cut=30 (see docs/analysis.md)")
      ->allow_extra_args(false);
  command
      ->add_option("--threads", arguments->options.threads,
                   "Frames analysed in parallel; the result does not depend on it")
      ->capture_default_str()
      ->check(in_range(1, 256));
  command->add_flag("--force", arguments->options.force,
                    "Recompute the analysis even if a valid one is stored");
  command->add_flag("--json", arguments->json,
                    "Print a JSON list with all series of each run, in SI units and radians");
  command->add_flag("-q,--quiet", arguments->quiet, "Show no progress");
  command->callback([arguments] { analyze(*arguments); });
}

}  // namespace talus::app
