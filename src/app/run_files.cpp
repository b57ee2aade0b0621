#include "app/run_files.h"

#include <filesystem>
#include <fmt/core.h>

#include "app/terminal.h"
#include "base/errors.h"
#include "base/locked_file.h"
#include "ensemble/ensemble_manifest.h"
#include "ensemble/member_state.h"
#include "io/durable_file.h"
#include "io/run_store.h"

namespace talus::app {
namespace {

void add_done_members(const std::string& folder, std::vector<std::string>& runs) {
  const ensemble::EnsemblePlan plan = ensemble::plan_of(ensemble::read_ensemble(folder), folder);
  const std::vector<std::size_t> done = ensemble::done_members(plan);
  for (const std::size_t m : done) runs.push_back(plan.members[m].path);
  if (done.empty())
    throw Error(ExitCode::missing_input,
                "{}: no member of this ensemble is done yet; talus ensemble status {} shows their progress",
                folder, folder);
}

}  // namespace

std::vector<std::string> with_members(const std::vector<std::string>& paths) {
  std::vector<std::string> runs;
  for (const std::string& path : paths) {
    if (ensemble::is_ensemble(path))
      add_done_members(path, runs);
    else
      runs.push_back(path);
  }
  return runs;
}

std::vector<std::string> runs_among(const std::vector<std::string>& paths) {
  if (paths.size() < 2) return paths;
  std::vector<std::string> runs;
  for (const std::string& path : paths) {
    std::error_code unknown;
    if (std::filesystem::is_regular_file(path, unknown) && !io::begins_as_run(path))
      print_error("left out: {} is not a run\n", path);
    else
      runs.push_back(path);
  }
  if (runs.empty()) throw Error(ExitCode::bad_data, "none of these {} files is a run", paths.size());
  return runs;
}

OutputRule output_of_run(const std::string& run, bool overwrite) {
  return {overwrite, {run, io::run_folder(run)}};
}

OutputRule output_of_scenario(const std::string& file, const scenario::Scenario& scenario) {
  const std::string& bed = scenario.deposition.file;
  return bed.empty() ? OutputRule{true, {file}} : OutputRule{true, {file, bed, io::run_folder(bed)}};
}

void note_missing_locks() {
  if (const std::string problem = fetch_lock_problem(); !problem.empty())
    print_error(
        "talus: note: the file system has no locks ({}): do not start a second command that writes the same "
        "output, because it would not be refused\n",
        problem);
}

}  // namespace talus::app
