/// `talus study`: varies one setting of a scenario at a time, with the same seeds for each variation.

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "app/choices.h"
#include "app/commands.h"
#include "app/ensemble_workers.h"
#include "app/jobs_option.h"
#include "app/json.h"
#include "app/terminal.h"
#include "base/output_file.h"
#include "io/durable_file.h"
#include "studies/study_report.h"

namespace talus::app {
namespace {

struct StudyArguments {
  std::string scenario;
  std::string folder;
  std::vector<std::string> axes;
  std::vector<std::string> settings;
  std::string seeds = "1-4";
  std::optional<double> reference;
  int jobs = default_jobs();
  bool json = false;
};

Json runs_json(const studies::StudyResult& result) {
  Json runs = Json::object();
  for (const studies::StudyOutcome& outcome : result.outcomes) {
    Json& run = runs[result.plan.members[outcome.member].name];
    for (std::size_t k = 0; k < studies::study_quantity_count; ++k)
      run[studies::study_fields()[k].name] = outcome.figures[k];
    run["state_hash"] = outcome.state_hash;
    run["version"] = outcome.version;
  }
  return runs;
}

Json comparison_json(const studies::Comparison& found) {
  static const char* const words[] = {"unknown", "within error", "differs"};
  return {{"seeds", found.value.count},
          {"mean", found.value.mean},
          {"error", found.value.error},
          {"difference", found.difference.mean},
          {"difference_error", found.difference.error},
          {"verdict", words[static_cast<int>(verdict(found.difference))]}};
}

std::string study_json(const studies::StudyResult& result) {
  Json variations = Json::object();
  for (std::size_t v = 0; v < result.plan.variants.size(); ++v)
    for (std::size_t k = 0; k < studies::study_quantity_count; ++k)
      variations[result.plan.variants[v].name][studies::study_fields()[k].name] =
          comparison_json(studies::compare(result, v, static_cast<studies::StudyQuantity>(k)));
  return json_text({{"scenario", result.plan.scenario_file},
                    {"reference_deg", result.reference},
                    {"variations", variations},
                    {"runs", runs_json(result)}});
}

void study(const StudyArguments& arguments) {
  const studies::StudyPlan plan = studies::plan_study(arguments.scenario, arguments.settings, arguments.axes,
                                                      arguments.seeds, arguments.folder);
  const std::filesystem::path folder = arguments.folder;
  for (const char* table : {"study.csv", "study.md"})
    output_target((folder / table).string(), {true, {arguments.scenario}});
  const EnsembleView view =
      compute_ensemble({.seeds = plan.seeds, .variants = plan.variants},
                       {arguments.folder, {}, "", arguments.jobs}, {arguments.scenario});
  if (ensemble::done_members(plan).empty()) {
    refuse_failures(plan, "nothing can be compared");
    print_text(ensemble_text(view));  // other workers compute it
    return;
  }
  const studies::StudyResult result = studies::read_study(plan, arguments.reference);
  io::write_text(folder / "study.csv", studies::study_csv(result));
  io::write_text(folder / "study.md", studies::study_markdown(result));
  print("%s\n", (arguments.json ? study_json(result) : studies::study_markdown(result)).c_str());
  refuse_failures(plan, "left out of the tables");
}

}  // namespace

void add_study_command(CLI::App& app) {
  auto arguments = std::make_shared<StudyArguments>();
  CLI::App* command = app.add_subcommand(
      "study", "Vary one setting of a scenario at a time, and compare the results over seeds");
  command->add_option("SCENARIO", arguments->scenario, "Scenario file (TOML; see docs/scenario.md)")
      ->required();
  command->add_option("-o,--output", arguments->folder, "Folder of the study; complete members are kept")
      ->required();
  command
      ->add_option("--vary", arguments->axes,
                   "Values of a key, e.g. tilt.step=0.002,0.0005; or of several keys together, e.g. "
                   "tilt.rate:tilt.step=2:0.002,0.5:0.0005")
      ->allow_extra_args(false);
  command->add_option("--seeds", arguments->seeds, "Seeds of each variation, e.g. 1-4 or 1-3,8")
      ->capture_default_str();
  command
      ->add_option("--set", arguments->settings,
                   "Change a key of the scenario in all runs, e.g. --set contact.friction=0.3")
      ->allow_extra_args(false);
  command
      ->add_option("--reference", arguments->reference,
                   "Tilt at which beds are compared, deg [smallest theta_c, rounded down to a whole degree]")
      ->check(in_range(0.0, 60.0));
  add_jobs_option(*command, arguments->jobs);
  command->add_flag("--json", arguments->json, "Print JSON");
  command->callback([arguments] { study(*arguments); });
}

}  // namespace talus::app
