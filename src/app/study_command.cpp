/// `talus study`: a scenario with one thing changed at a time, each variation with the same seeds.

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <thread>

#include "app/commands.h"
#include "app/missing_runs.h"
#include "app/study_report.h"
#include "io/durable_file.h"

namespace talus {
namespace {

struct StudyArguments {
  std::string scenario;
  std::string folder;
  std::vector<std::string> axes;
  std::vector<std::string> settings;
  std::string seeds = "1-4";
  std::optional<double> reference;
  int jobs = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  bool json = false;
};

std::vector<WantedRun> wanted_runs(const StudyPlan& plan, const std::string& folder) {
  std::vector<WantedRun> runs;
  for (const StudyRun& run : plan.runs)
    runs.push_back({run.name, study_path(folder, run), plan.scenario_file,
                    plan.variations[run.variation].settings, run.scenario});
  return runs;
}

void write_text(const std::filesystem::path& path, const std::string& text) {
  write_durably(path.string(), std::as_bytes(std::span(text)), path.string() + ".part");
}

void study(const StudyArguments& arguments) {
  const StudyPlan plan = plan_study(arguments.scenario, arguments.settings, arguments.axes, arguments.seeds);
  const std::vector<FailedRun> failed =
      compute_missing(wanted_runs(plan, arguments.folder), arguments.jobs, "study");
  if (failed.size() == plan.runs.size()) refuse(failed);
  const StudyResult result = read_study(plan, arguments.folder, arguments.reference);
  const std::filesystem::path folder = arguments.folder;
  write_text(folder / "study.csv", study_csv(result));
  write_text(folder / "study.md", study_markdown(result));
  std::printf("%s\n", (arguments.json ? study_json(result) : study_markdown(result)).c_str());
  if (!failed.empty()) refuse(failed);
}

}  // namespace

void add_study_command(CLI::App& app) {
  auto arguments = std::make_shared<StudyArguments>();
  CLI::App* command = app.add_subcommand(
      "study", "Run a scenario with one thing changed at a time, and compare the figures over seeds");
  command->add_option("scenario", arguments->scenario, "Scenario file (TOML; see docs/scenario.md)")
      ->required();
  command->add_option("-o,--output", arguments->folder, "Folder of the study; what is complete in it is kept")
      ->required();
  command
      ->add_option("--vary", arguments->axes,
                   "Values of a key, e.g. tilt.step=0.002,0.0005; or of several together, e.g. "
                   "tilt.rate:tilt.step=2:0.002,0.5:0.0005")
      ->allow_extra_args(false);
  command->add_option("--seeds", arguments->seeds, "Seeds of each variation, e.g. 1-4 or 1-3,8")
      ->capture_default_str();
  command
      ->add_option("--set", arguments->settings,
                   "Change a key of the scenario in all runs, e.g. --set contact.friction=0.3")
      ->allow_extra_args(false);
  command
      ->add_option("--at", arguments->reference,
                   "Angle at which beds are compared, deg [smallest theta_c, rounded down to a whole degree]")
      ->check(CLI::Range(0.0, 60.0));
  command->add_option("--jobs", arguments->jobs, "Runs side by side, each on one thread")
      ->capture_default_str()
      ->check(CLI::Range(1, 256));
  command->add_flag("--json", arguments->json, "Print the result as JSON");
  command->callback([arguments] { study(*arguments); });
}

}  // namespace talus
