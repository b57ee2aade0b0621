/// `talus study`: varies one setting of a scenario at a time, with the same seeds for each variation. The
/// module talus.study of the Python package compares the results.

#include <filesystem>
#include <fmt/core.h>
#include <memory>
#include <optional>

#include "app/commands.h"
#include "app/ensemble_workers.h"
#include "app/options.h"
#include "app/other_programs.h"
#include "app/terminal.h"
#include "base/output_file.h"
#include "ensemble/ensemble_manifest.h"
#include "ensemble/member_state.h"

namespace talus::app {
namespace {

struct StudyArguments : EnsembleWorkers {
  std::string scenario;
  std::vector<std::string> axes;
  std::vector<std::string> settings;
  std::string seeds = "1-4";
  std::optional<double> reference;
  bool json = false;
};

/// Returns the tables of a study, which the module also writes into its folder.
std::string make_tables(const StudyArguments& arguments, const ensemble::EnsemblePlan& plan) {
  std::vector<std::string> words = {"--scenario=" + arguments.scenario, "--seeds=" + arguments.seeds};
  for (const ensemble::Variant& variant : plan.variants) words.push_back("--variant=" + variant.name);
  if (arguments.reference) words.push_back(fmt::format("--reference={}", *arguments.reference));
  if (arguments.json) words.emplace_back("--json");
  words.insert(words.end(), {"--", arguments.folder});
  return output_of_python_module("study", words);
}

void study(const StudyArguments& arguments) {
  std::vector<ensemble::Variant> variants =
      ensemble::plan_one_at_a_time(arguments.scenario, arguments.settings, arguments.axes);
  const ensemble::EnsemblePlan plan =
      ensemble::plan_ensemble(ensemble::parse_seeds(arguments.seeds), std::move(variants), arguments.folder);
  for (const char* table : {"study.csv", "study.md"})
    output_target((std::filesystem::path(arguments.folder) / table).string(), {true, {arguments.scenario}});
  output_of_python_module("study", {"--help"});  // before runs that take hours: is everything installed?
  const EnsembleView view =
      compute_ensemble({.seeds = plan.seeds, .variants = plan.variants}, arguments, {arguments.scenario});
  if (ensemble::done_members(plan).empty()) {
    refuse_failures(plan, "nothing can be compared");
    print_text(ensemble_text(view));  // other workers compute it
    return;
  }
  print_text(make_tables(arguments, plan));
  refuse_failures(plan, "left out of the tables");
}

}  // namespace

void add_study_command(CLI::App& app) {
  auto arguments = std::make_shared<StudyArguments>();
  CLI::App* command = app.add_subcommand(
      "study", "Vary one setting of a scenario at a time, and compare the results over seeds");
  command->add_option("SCENARIO", arguments->scenario, "Scenario file (TOML; see docs/scenario.md)")
      ->required();
  add_option(*command, "-o,--output", arguments->folder, "FOLDER",
             "Folder of the study; complete members are kept")
      ->required();
  add_option(*command, "--vary", arguments->axes, "KEY=VALUE,...",
             "Values of a key, e.g. tilt.step=0.002,0.0005; or of several keys together, e.g. "
             "tilt.rate:tilt.step=2:0.002,0.5:0.0005")
      ->allow_extra_args(false);
  add_option(*command, "--seeds", arguments->seeds, "SEEDS", "Seeds of each variation, e.g. 1-4 or 1-3,8")
      ->capture_default_str();
  add_scenario_settings(*command, arguments->settings, " in all runs");
  add_option(*command, "--reference", arguments->reference, "DEG",
             "Tilt at which beds are compared, deg [smallest theta_c, rounded down to a whole degree]")
      ->check(in_range(0.0, 60.0));
  add_jobs_option(*command, arguments->jobs);
  command->add_flag("--json", arguments->json, "Print JSON");
  command->callback([arguments] { study(*arguments); });
}

}  // namespace talus::app
