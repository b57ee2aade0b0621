/// `talus perturb`: finds how strong a push starts an avalanche, at tilts before failure.

#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fmt/core.h>
#include <memory>
#include <optional>
#include <thread>

#include "app/choices.h"
#include "app/command_line.h"
#include "app/commands.h"
#include "app/ensemble_workers.h"
#include "app/figure_files.h"
#include "app/figure_runs.h"
#include "app/figure_text.h"
#include "app/gnuplot.h"
#include "app/jobs_option.h"
#include "app/perturbed_run.h"
#include "app/terminal.h"
#include "base/errors.h"
#include "base/output_file.h"
#include "base/visible_text.h"
#include "core/trigonometry.h"
#include "ensemble/worker.h"
#include "figures/perturbation_figure.h"
#include "io/durable_file.h"
#include "runs/analysis_parameters.h"

namespace talus::app {
namespace {

struct PerturbArguments {
  std::string scenario;
  std::string folder;
  std::vector<std::string> settings;
  std::string seeds = "1-4";
  std::optional<std::uint64_t> seed;
  session::PerturbationPlan plan;
  std::string patch = "10x2";
  int jobs = default_jobs();
};

/// Returns a manifest with one unnamed variant, whose runs are in the folder itself.
ensemble::EnsembleManifest manifest_of(const PerturbArguments& arguments) {
  return {.seeds = ensemble::parse_seeds(arguments.seed ? std::to_string(*arguments.seed) : arguments.seeds),
          .variants = ensemble::plan_variants(arguments.scenario, arguments.settings, {}),
          .task = arguments.plan};
}

/// Adds one seed to the ensemble and computes only that seed. Waits if another process computes it.
void perturb_seed(const PerturbArguments& arguments, const ensemble::EnsembleManifest& wanted) {
  ensemble::KnownMembers known;
  begin_ensemble(arguments.folder, wanted, {arguments.scenario}, known);
  const ensemble::EnsemblePlan plan = ensemble::plan_of(wanted, arguments.folder);
  ensemble::WorkerOptions options{arguments.folder, {}, {}, {}, plan.members.front().name, on_wait};
  while (ensemble::work_on_ensemble(options).elsewhere > 0)
    std::this_thread::sleep_for(std::chrono::seconds(1));
  refuse_failures(plan, "its trials are not complete");
  const std::string& run = plan.members.front().path;
  session::table_of(io::RunFile::open(run), arguments.plan,
                    run);  // an existing run may lack the trials
}

/// Throws if no state was perturbed, because the figure would be empty.
void refuse_no_states(const PerturbArguments& arguments, const figures::RunGroup& group,
                      const figures::Table& states) {
  if (!states.columns.front().values.empty()) return;
  double lowest = not_known, highest = not_known;
  for (const runs::RunView& run : group.runs) {
    lowest = std::fmin(lowest, degrees(run.analysis.theta_c));
    highest = std::fmax(highest, degrees(run.analysis.theta_c));
  }
  const std::string end = std::isnan(lowest)
                              ? std::string("none of the beds failed")
                              : fmt::format("the beds failed at {:.2f} to {:.2f} deg", lowest, highest);
  throw Error(
      ExitCode::bad_data,
      fmt::format("no copy was pushed: no tilt of at least {:g} deg (--from) was reached before failure, "
                  "and {}; use a lower --from and another folder",
                  arguments.plan.first, end));
}

/// Reports the finished seeds. Writes the tables in any case, and the figure if gnuplot is installed.
void report(const PerturbArguments& arguments, const ensemble::EnsemblePlan& plan) {
  std::vector<std::string> paths;
  std::vector<session::PerturbationTable> tables;
  for (const std::size_t m : ensemble::done_members(plan)) {
    const ensemble::Member& member = plan.members[m];
    paths.push_back(member.path);
    tables.push_back(session::table_of(io::RunFile::open(member.path), arguments.plan, member.path));
  }
  const std::vector<figures::RunGroup> groups =
      figures::group_runs(open_figure_runs(paths, runs::parse_analysis_settings({}), {}));
  const std::filesystem::path folder = arguments.folder;
  const figures::Figure figure = figures::perturbation_figure(groups.front(), tables);
  const std::string text = figures::perturbation_markdown(groups.front(), tables);
  io::write_text(folder / figures::file_of(figure, figure.tables.front()), csv_text(figure.tables.front()));
  io::write_text(folder / "perturb.md", text);
  refuse_no_states(arguments, groups.front(), figure.tables.front());
  print_text(text);
  try {
    require_gnuplot();
    write_figure(figure, groups, arguments.folder, {.command_line = command_line()});
  } catch (const Error& error) {
    if (error.code() != ExitCode::unavailable) throw;
    print_error("talus: warning: the figure is left out: %s\n", error.what());
  }
}

void run_perturb(PerturbArguments& arguments) {
  const std::optional<session::SurfacePatch> patch = session::parse_patch(arguments.patch);
  if (!patch)
    throw Error(ExitCode::usage,
                fmt::format("--patch {}: expected width and depth in mean diameters, e.g. 10x2",
                            visible_word(arguments.patch)));
  arguments.plan.patch = *patch;
  const ensemble::EnsembleManifest wanted = manifest_of(arguments);
  output_target((std::filesystem::path(arguments.folder) / "perturb.md").string(),
                {true, {arguments.scenario}});
  if (arguments.seed) return perturb_seed(arguments, wanted);
  const EnsembleView view =
      compute_ensemble(wanted, {arguments.folder, {}, "", arguments.jobs}, {arguments.scenario});
  const ensemble::EnsemblePlan plan = ensemble::plan_of(wanted, arguments.folder);
  if (ensemble::done_members(plan).empty()) {
    refuse_failures(plan, "nothing can be reported");
    print_text(ensemble_text(view));  // other workers compute it
    return;
  }
  report(arguments, plan);
  refuse_failures(plan, "left out of the tables");
}

}  // namespace

void add_perturb_command(CLI::App& app) {
  auto arguments = std::make_shared<PerturbArguments>();
  CLI::App* command = app.add_subcommand(
      "perturb",
      "Push the surface at tilts up to failure, and find the weakest push that starts an avalanche");
  command->add_option("SCENARIO", arguments->scenario, "Scenario file (TOML; see docs/scenario.md)")
      ->required();
  command
      ->add_option("-o,--output", arguments->folder, "Folder of runs and tables; complete members are kept")
      ->required();
  CLI::Option* seeds =
      command->add_option("--seeds", arguments->seeds, "Seeds, e.g. 1-4 or 1-3,8")->capture_default_str();
  command->add_option("--seed", arguments->seed, "Compute only this seed, without a summary; for job arrays")
      ->excludes(seeds);
  command
      ->add_option("--from", arguments->plan.first, "First tilt at which copies of the bed are pushed, deg")
      ->capture_default_str()
      ->check(in_range(0.0, session::PerturbationPlan::highest));
  command->add_option("--every", arguments->plan.every, "Interval of tilt between these states, deg")
      ->capture_default_str()
      ->check(in_range(session::PerturbationPlan::min_every, session::PerturbationPlan::highest));
  command
      ->add_option("--patch", arguments->patch,
                   "Width and depth of the pushed part of the surface, in mean diameters")
      ->capture_default_str();
  command
      ->add_option("--set", arguments->settings,
                   "Change a key of the scenario, e.g. --set deposition.friction=0.15")
      ->allow_extra_args(false);
  add_jobs_option(*command, arguments->jobs);
  command->callback([arguments] { run_perturb(*arguments); });
}

}  // namespace talus::app
