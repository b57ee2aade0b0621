/// `talus perturb`: finds how strong a push starts an avalanche, at tilts before failure.

#include <chrono>
#include <filesystem>
#include <fmt/core.h>
#include <memory>
#include <optional>
#include <thread>

#include "app/choices.h"
#include "app/command_line.h"
#include "app/commands.h"
#include "app/ensemble_workers.h"
#include "app/jobs_option.h"
#include "app/member_trials.h"
#include "app/python_module.h"
#include "app/terminal.h"
#include "base/errors.h"
#include "base/output_file.h"
#include "base/visible_text.h"
#include "ensemble/worker.h"

namespace talus::app {
namespace {

struct PerturbArguments {
  std::string scenario;
  std::string folder;
  std::vector<std::string> settings;
  std::string seeds = "1-4";
  std::optional<std::uint64_t> seed;
  ensemble::TrialsTask plan;
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
  require_trials(io::RunFile::open(run), arguments.plan, run);  // an existing run may lack them
}

/// Reports the finished seeds: tables, and the figure if matplotlib is installed.
void report(const PerturbArguments& arguments, const ensemble::EnsemblePlan& plan) {
  std::vector<std::string> words = {"report", arguments.folder, ensemble::patch_text(arguments.plan.patch),
                                    fmt::format("{:g}", arguments.plan.first), command_line()};
  for (const std::size_t m : ensemble::done_members(plan)) {
    const std::string& run = plan.members[m].path;
    require_trials(io::RunFile::open(run), arguments.plan, run);
    words.push_back(run);
  }
  print_text(output_of_python_module("perturb", words));
}

void run_perturb(PerturbArguments& arguments) {
  const std::optional<ensemble::SurfacePatch> patch = ensemble::parse_patch(arguments.patch);
  if (!patch)
    throw Error(ExitCode::usage,
                fmt::format("--patch {}: expected width and depth in mean diameters, e.g. 10x2",
                            visible_word(arguments.patch)));
  arguments.plan.patch = *patch;
  const ensemble::EnsembleManifest wanted = manifest_of(arguments);
  output_target((std::filesystem::path(arguments.folder) / "perturb.md").string(),
                {true, {arguments.scenario}});
  output_of_python_module("perturb", {"check"});  // before long work
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
      ->check(in_range(0.0, ensemble::TrialsTask::highest));
  command->add_option("--every", arguments->plan.every, "Interval of tilt between these states, deg")
      ->capture_default_str()
      ->check(in_range(ensemble::TrialsTask::min_every, ensemble::TrialsTask::highest));
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
