#include "app/missing_runs.h"

#include <filesystem>

#include "core/errors.h"
#include "io/run_file.h"
#include "session/estimate.h"
#include "session/run_header.h"

namespace talus {
namespace {

/// Whether a run is complete. Throws Error(bad_data) where the run at its path has another scenario.
bool is_complete(const WantedRun& run, const std::string& whole) {
  const RunPresence presence = run_presence(run.path);
  if (presence == RunPresence::none) return false;
  // Values are compared, not texts: a key that an earlier version did not have is at its default in it.
  if (stored_scenario(RunFile::open(run.path).header(), run.path) != run.scenario)
    throw Error(ExitCode::bad_data, run.path + " is a run of another scenario than this " + whole +
                                        "'s; expected the scenario, the settings and the version that the " +
                                        whole + " began with; give another folder");
  return presence == RunPresence::packed;
}

/// `talus run`, as a user would type it.
ChildRun child_of(const WantedRun& run) {
  ChildRun child;
  child.arguments = {"run", run.scenario_file, "-o", run.path, "--resume", "--threads", "1"};
  for (const std::string& setting : run.settings) {
    child.arguments.emplace_back("--set");
    child.arguments.push_back(setting);
  }
  child.arguments.emplace_back("--seed");
  child.arguments.push_back(std::to_string(run.scenario.seed));
  child.log = std::filesystem::path(run.path).replace_extension(".log").string();
  return child;
}

}  // namespace

std::vector<FailedRun> compute_missing(const std::vector<WantedRun>& runs, int jobs,
                                       const std::string& whole) {
  std::vector<ChildRun> children;
  std::vector<AwaitedRun> awaited;
  for (const WantedRun& run : runs) {
    if (is_complete(run, whole)) continue;
    make_folders(std::filesystem::path(run.path).parent_path().string());
    children.push_back(child_of(run));
    awaited.push_back({run.name, estimate(run.scenario).seconds});
  }
  return run_with_progress(children, {whole, "runs"}, std::move(awaited), runs.size() - children.size(), jobs,
                           whole);
}

std::vector<FailedRun> run_with_progress(const std::vector<ChildRun>& children, ProgressWords words,
                                         std::vector<AwaitedRun> awaited, std::size_t complete, int jobs,
                                         const std::string& whole) {
  if (children.empty()) return {};
  RunsProgress progress(std::move(words), std::move(awaited), complete, jobs);
  std::vector<FailedRun> failed;
  ChildEvents events;
  events.on_start = [&](std::size_t k) { progress.start(k); };
  events.on_end = [&](std::size_t k, int exit_code) {
    progress.end(k, exit_code);
    if (exit_code != 0) failed.push_back({children[k].log, exit_code});
  };
  events.on_wait = [&] { progress.show(); };
  const bool all = run_children(children, jobs, events);
  progress.finish();
  if (!all) throw Error(ExitCode::stopped, "the " + whole + " was stopped; the same command goes on with it");
  return failed;
}

void refuse(const std::vector<FailedRun>& failed, const std::string& consequence) {
  std::string text = std::to_string(failed.size()) + (failed.size() == 1 ? " run" : " runs") +
                     " ended with an error, " + consequence + "; what happened is in";
  for (const FailedRun& run : failed)
    text += "\n  " + run.log + " (exit code " + std::to_string(run.exit_code) + ")";
  const int code = failed.front().exit_code;
  throw Error(code > 128 ? ExitCode::internal : static_cast<ExitCode>(code), text);
}

void make_folders(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw Error(ExitCode::cannot_create, folder + ": cannot create the folder: " + error.message());
}

}  // namespace talus
