/// `talus perturb`: how strong a push starts an avalanche, at tilts on the way to failure.

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <thread>

#include "app/child_runs.h"
#include "app/command_line.h"
#include "app/commands.h"
#include "app/figure_files.h"
#include "app/figure_runs.h"
#include "app/figure_text.h"
#include "app/gnuplot.h"
#include "app/missing_runs.h"
#include "app/perturb_report.h"
#include "app/perturb_seed.h"
#include "app/runs_progress.h"
#include "core/errors.h"
#include "figures/perturbation_figure.h"
#include "io/durable_file.h"
#include "session/estimate.h"
#include "session/scenario_text.h"
#include "session/study.h"

namespace talus {
namespace {

struct PerturbArguments {
  std::string scenario;
  std::string folder;
  std::vector<std::string> settings;
  std::string seeds = "1-4";
  std::optional<std::uint64_t> seed;
  PerturbationPlan plan;
  std::string patch = "10x2";
  int jobs = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
};

/// The command of one seed, as a user would type it, from the subcommand on.
std::vector<std::string> words_of(const PerturbArguments& arguments, std::uint64_t seed) {
  std::vector<std::string> words = {"perturb", arguments.scenario,
                                    "-o",      arguments.folder,
                                    "--seed",  std::to_string(seed),
                                    "--from",  short_text(arguments.plan.first),
                                    "--every", short_text(arguments.plan.every),
                                    "--patch", patch_text(arguments.plan.patch)};
  for (const std::string& setting : arguments.settings) {
    words.emplace_back("--set");
    words.push_back(setting);
  }
  return words;
}

RunRequest request_of(const PerturbArguments& arguments, std::uint64_t seed) {
  const std::filesystem::path folder = arguments.folder;
  RunRequest request;
  request.scenario = arguments.scenario;
  request.output = (folder / ("seed-" + std::to_string(seed) + ".h5")).string();
  request.settings = arguments.settings;
  request.settings.push_back("seed=" + std::to_string(seed));
  request.command_line = "talus";
  for (const std::string& word : words_of(arguments, seed)) request.command_line += " " + word;
  return request;
}

/// Computes the seeds that are not complete, each in a process of its own, and returns those that ended with
/// an error. Throws Error(stopped), and as is_perturbed does.
std::vector<FailedRun> compute(const PerturbArguments& arguments, const std::vector<std::uint64_t>& seeds) {
  std::vector<ChildRun> children;
  std::vector<AwaitedRun> awaited;
  for (const std::uint64_t seed : seeds) {
    const RunRequest request = request_of(arguments, seed);
    const Scenario scenario = read_scenario(request.scenario, request.settings);
    if (is_perturbed(request, arguments.plan)) continue;
    const std::string log = std::filesystem::path(request.output).replace_extension(".log").string();
    children.push_back({words_of(arguments, seed), log});
    awaited.push_back({"seed " + std::to_string(seed), estimate(scenario).seconds});
  }
  if (children.empty()) return {};
  make_folders(arguments.folder);
  RunsProgress progress({"perturb", "runs"}, std::move(awaited), seeds.size() - children.size(),
                        arguments.jobs);
  std::vector<FailedRun> failed;
  ChildEvents events;
  events.on_start = [&](std::size_t k) { progress.start(k); };
  events.on_end = [&](std::size_t k, int exit_code) {
    progress.end(k, exit_code);
    if (exit_code != 0) failed.push_back({children[k].log, exit_code});
  };
  events.on_wait = [&] { progress.show(); };
  const bool all = run_children(children, arguments.jobs, events);
  progress.finish();
  if (!all) throw Error(ExitCode::stopped, "stopped; the same command goes on with it");
  return failed;
}

void write_text(const std::filesystem::path& path, const std::string& text) {
  write_durably(path.string(), std::as_bytes(std::span(text)), path.string() + ".part");
}

/// Reports the seeds that are complete. The tables are written in any case, the figure where there is a
/// gnuplot.
void report(const PerturbArguments& arguments, const std::vector<std::uint64_t>& seeds) {
  std::vector<std::string> paths;
  std::vector<PerturbationTable> tables;
  for (const std::uint64_t seed : seeds) {
    const RunRequest request = request_of(arguments, seed);
    if (!is_perturbed(request, arguments.plan)) continue;
    paths.push_back(request.output);
    tables.push_back(read_perturbation_table(request.output, arguments.plan));
  }
  const std::vector<RunGroup> groups = group_runs(open_figure_runs(paths, parse_analysis_settings({}), {}));
  const std::filesystem::path folder = arguments.folder;
  const Figure figure = perturbation_figure(groups.front(), tables);
  const std::string text = perturbation_markdown(groups.front(), tables);
  write_text(folder / file_of(figure, figure.tables.front()), csv_text(figure.tables.front()));
  write_text(folder / "perturb.md", text);
  std::printf("%s", text.c_str());
  try {
    require_gnuplot();
    write_figure(figure, groups, arguments.folder, {.columns = 0, .command_line = command_line()});
  } catch (const Error& error) {
    if (error.code() != ExitCode::unavailable) throw;
    std::fprintf(stderr, "talus: warning: the figure is left out: %s\n", error.what());
  }
}

void run_perturb(PerturbArguments& arguments) {
  const std::optional<SurfacePatch> patch = parse_patch(arguments.patch);
  if (!patch)
    throw Error(ExitCode::usage, "--patch " + printable(arguments.patch) +
                                     ": expected width and depth in mean diameters, such as 10x2");
  arguments.plan.patch = *patch;
  const std::vector<std::uint64_t> seeds =
      arguments.seed ? std::vector{*arguments.seed} : parse_seeds(arguments.seeds);
  if (arguments.seed) {
    make_folders(arguments.folder);
    return perturb_seed(request_of(arguments, seeds.front()), arguments.plan);
  }
  const std::vector<FailedRun> failed = compute(arguments, seeds);
  if (failed.size() < seeds.size()) report(arguments, seeds);
  if (!failed.empty()) refuse(failed);
}

}  // namespace

void add_perturb_command(CLI::App& app) {
  auto arguments = std::make_shared<PerturbArguments>();
  CLI::App* command = app.add_subcommand(
      "perturb",
      "Push on the surface at tilts up to failure, and find the weakest push that starts an avalanche");
  command->add_option("scenario", arguments->scenario, "Scenario file (TOML; see docs/scenario.md)")
      ->required();
  command
      ->add_option("-o,--output", arguments->folder,
                   "Folder of runs and tables; what is complete in it is kept")
      ->required();
  CLI::Option* seeds =
      command->add_option("--seeds", arguments->seeds, "Seeds, e.g. 1-4 or 1-3,8")->capture_default_str();
  command
      ->add_option("--seed", arguments->seed,
                   "Compute this one in this process and make no tables of all, as for a job array")
      ->excludes(seeds);
  command->add_option("--from", arguments->plan.first, "First tilt at which copies are pushed, deg")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 60.0));
  command->add_option("--every", arguments->plan.every, "Tilt between these states, deg")
      ->capture_default_str()
      ->check(CLI::Range(1e-3, 60.0));
  command
      ->add_option("--patch", arguments->patch,
                   "Width and depth of the part of the surface that is pushed, D")
      ->capture_default_str();
  command
      ->add_option("--set", arguments->settings,
                   "Change a key of the scenario, e.g. --set deposition.friction=0.15")
      ->allow_extra_args(false);
  command->add_option("--jobs", arguments->jobs, "Seeds side by side, each on one thread")
      ->capture_default_str()
      ->check(CLI::Range(1, 256));
  command->callback([arguments] { run_perturb(*arguments); });
}

}  // namespace talus
