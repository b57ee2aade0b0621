/// `talus reproduce`: the paper's beds, tilted, analysed and drawn, and a report that stands beside the
/// paper.

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <thread>

#include "app/commands.h"
#include "app/gnuplot.h"
#include "app/missing_runs.h"
#include "app/open_run.h"
#include "app/progress.h"
#include "app/reproduction_figures.h"
#include "app/reproduction_report.h"
#include "app/reproduction_values.h"
#include "core/errors.h"
#include "io/durable_file.h"
#include "reproduction/built_in_scenarios.h"
#include "session/estimate.h"

namespace talus {
namespace {

namespace fs = std::filesystem;

struct ReproduceArguments {
  bool quick = false;
  std::string folder;
  std::string seeds;
  int jobs = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
};

void write_text(const fs::path& path, const std::string& text) {
  write_durably(path.string(), std::as_bytes(std::span(text)), path.string() + ".part");
}

std::string scenario_path(const std::string& folder, const ReproducedBed& bed) {
  return (fs::path(folder) / "scenarios" / (bed.scenario_name + ".toml")).string();
}

/// The built-in scenarios as files: `talus run` reads them, and so can a user.
void write_scenarios(const ReproductionPlan& plan, const std::string& folder) {
  make_folders((fs::path(folder) / "scenarios").string());
  for (const ReproducedBed& bed : plan.beds)
    write_text(scenario_path(folder, bed), std::string(built_in_scenario(bed.scenario_name)));
}

std::vector<WantedRun> wanted_runs(const ReproductionPlan& plan, const WorkOptions& options) {
  std::vector<WantedRun> runs;
  for (const ReproducedRun& run : plan.runs) {
    const ReproducedBed& bed = plan.beds[run.bed];
    runs.push_back(
        {run.name, run_path(options, run), scenario_path(options.folder, bed), bed.settings, run.scenario});
  }
  return runs;
}

/// What is still to be run, and how long that may take.
void announce(const ReproductionPlan& plan, const WorkOptions& options) {
  double seconds = 0.0;
  std::size_t missing = 0;
  for (const ReproducedRun& run : plan.runs) {
    if (run_presence(run_path(options, run)) == RunPresence::packed) continue;
    seconds += estimate(run.scenario).seconds;
    ++missing;
  }
  std::fprintf(stderr, "%zu of %zu runs to compute, about %s on %d processor%s; then analyses and figures\n",
               missing, plan.runs.size(), duration_text(seconds / options.jobs).c_str(), options.jobs,
               options.jobs == 1 ? "" : "s");
}

void write_report(const ReproductionResult& result, const std::vector<ReportPicture>& pictures,
                  const std::string& folder) {
  const ReportDocument document = reproduction_report(result, pictures);
  write_text(fs::path(folder) / "values.csv", values_csv(result));
  write_text(fs::path(folder) / "report.md", report_markdown(document));
  write_text(fs::path(folder) / "report.html", report_html(document, folder));
  for (const std::string& item : reproduction_summary(result)) std::printf("- %s\n", item.c_str());
  std::printf("The report is %s\n", (fs::path(folder) / "report.html").c_str());
}

void reproduce(const ReproduceArguments& arguments) {
  const std::string folder = !arguments.folder.empty() ? arguments.folder
                             : arguments.quick         ? "reproduction-quick"
                                                       : "reproduction";
  const std::string seeds = !arguments.seeds.empty() ? arguments.seeds : arguments.quick ? "1" : "1-2";
  const ReproductionPlan plan = plan_reproduction(arguments.quick, seeds);
  require_gnuplot();
  const WorkOptions options{folder, arguments.jobs, catch_stop_signals()};
  write_scenarios(plan, folder);
  announce(plan, options);
  const std::vector<FailedRun> failed =
      compute_missing(wanted_runs(plan, options), arguments.jobs, "reproduction");
  const std::string consequence = "left out of the report";
  if (failed.size() == plan.runs.size()) refuse(failed, consequence);
  analyse_missing(plan, options);
  const ReproductionResult result = measure_runs(plan, options);
  write_report(result, draw_figures(plan, options), folder);
  if (!failed.empty()) refuse(failed, consequence);
}

}  // namespace

void add_reproduce_command(CLI::App& app) {
  auto arguments = std::make_shared<ReproduceArguments>();
  CLI::App* command = app.add_subcommand(
      "reproduce", "Run, analyse and draw the paper's beds, and write a report beside the paper");
  command->add_flag(
      "--quick", arguments->quick,
      "Beds of half the depth, in some minutes; lengths cannot be compared with the paper then");
  command->add_option("-o,--output", arguments->folder,
                      "Folder of runs, figures and report; what is complete in it is kept [reproduction, or "
                      "reproduction-quick]");
  command->add_option("--seeds", arguments->seeds, "Seeds of each bed, e.g. 1-4 or 1-3,8 [1-2; quick: 1]");
  command->add_option("--jobs", arguments->jobs, "Runs side by side, each on one thread")
      ->capture_default_str()
      ->check(CLI::Range(1, 256));
  command->callback([arguments] { reproduce(*arguments); });
}

}  // namespace talus
