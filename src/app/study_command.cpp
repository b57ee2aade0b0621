/// `talus study`: a scenario with one thing changed at a time, each variation with the same seeds.

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <thread>

#include "app/child_runs.h"
#include "app/commands.h"
#include "app/study_progress.h"
#include "app/study_report.h"
#include "core/errors.h"
#include "io/durable_file.h"
#include "session/estimate.h"

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

/// Whether a run is complete. Throws Error(bad_data) where the run at that path has another scenario.
bool is_complete(const std::string& path, const StudyRun& run) {
  const RunPresence presence = run_presence(path);
  if (presence == RunPresence::none) return false;
  if (RunFile::open(path).header().scenario_resolved != resolved_toml(run.scenario))
    throw Error(ExitCode::bad_data,
                path +
                    " is a run of another scenario than this study's; expected the scenario, the settings "
                    "and the version that the study began with; give another folder");
  return presence == RunPresence::packed;
}

/// `talus run` of a run of the study, as a user would type it.
ChildRun child_of(const StudyPlan& plan, const StudyRun& run, const std::string& path) {
  ChildRun child;
  child.arguments = {"run", plan.scenario_file, "-o", path, "--resume", "--threads", "1"};
  for (const std::string& setting : plan.variations[run.variation].settings) {
    child.arguments.emplace_back("--set");
    child.arguments.push_back(setting);
  }
  child.arguments.emplace_back("--seed");
  child.arguments.push_back(std::to_string(run.seed));
  child.log = std::filesystem::path(path).replace_extension(".log").string();
  return child;
}

void create_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw Error(ExitCode::cannot_create, folder.string() + ": cannot create the folder: " + error.message());
}

struct FailedRun {
  std::string log;
  int exit_code = 0;
};

/// Computes what is not complete yet and returns the runs that ended with an error. Throws Error(stopped).
std::vector<FailedRun> compute(const StudyArguments& arguments, const StudyPlan& plan) {
  std::vector<ChildRun> children;
  std::vector<AwaitedRun> awaited;
  for (const StudyRun& run : plan.runs) {
    const std::string path = study_path(arguments.folder, run);
    if (is_complete(path, run)) continue;
    create_folder(std::filesystem::path(path).parent_path());
    children.push_back(child_of(plan, run, path));
    awaited.push_back({run.name, estimate(run.scenario).seconds});
  }
  if (children.empty()) return {};
  StudyProgress progress(std::move(awaited), plan.runs.size() - children.size(), arguments.jobs);
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
  if (!all) throw Error(ExitCode::stopped, "the study was stopped; the same command goes on with it");
  return failed;
}

[[noreturn]] void refuse(const std::vector<FailedRun>& failed) {
  std::string text = std::to_string(failed.size()) + (failed.size() == 1 ? " run" : " runs") +
                     " ended with an error, left out of the tables; what happened is in";
  for (const FailedRun& run : failed)
    text += "\n  " + run.log + " (exit code " + std::to_string(run.exit_code) + ")";
  const int code = failed.front().exit_code;
  throw Error(code > 128 ? ExitCode::internal : static_cast<ExitCode>(code), text);
}

void write_text(const std::filesystem::path& path, const std::string& text) {
  write_durably(path.string(), std::as_bytes(std::span(text)), path.string() + ".part");
}

void study(const StudyArguments& arguments) {
  const StudyPlan plan = plan_study(arguments.scenario, arguments.settings, arguments.axes, arguments.seeds);
  const std::vector<FailedRun> failed = compute(arguments, plan);
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
