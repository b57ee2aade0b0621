#include "app/given_runs.h"

#include <filesystem>
#include <fmt/core.h>

#include "app/terminal.h"
#include "base/errors.h"
#include "ensemble/ensemble_manifest.h"
#include "ensemble/member_state.h"
#include "io/seal.h"

namespace talus::app {
namespace {

std::vector<ensemble::Member> done_members(const std::string& folder) {
  const ensemble::EnsemblePlan plan = ensemble::plan_of(ensemble::read_ensemble(folder), folder);
  const std::vector<ensemble::MemberState> states = ensemble::scan_members(plan);
  std::vector<ensemble::Member> done;
  for (std::size_t m = 0; m < states.size(); ++m)
    if (states[m].stage == ensemble::MemberStage::done) done.push_back(plan.members[m]);
  if (done.empty())
    throw Error(
        ExitCode::missing_input,
        fmt::format(
            "{}: no member of this ensemble is done yet; talus ensemble status {} shows their progress",
            folder, folder));
  return done;
}

}  // namespace

std::vector<std::string> with_members(const std::vector<std::string>& paths) {
  std::vector<std::string> runs;
  for (const std::string& path : paths) {
    if (!ensemble::is_ensemble(path)) {
      runs.push_back(path);
      continue;
    }
    for (const ensemble::Member& member : done_members(path)) runs.push_back(member.path);
  }
  return runs;
}

std::vector<std::string> runs_among(const std::vector<std::string>& paths) {
  if (paths.size() < 2) return paths;
  std::vector<std::string> runs;
  for (const std::string& path : paths) {
    std::error_code unknown;
    if (std::filesystem::is_regular_file(path, unknown) && !io::begins_as_run(path))
      print_error("left out: %s is not a run\n", path.c_str());
    else
      runs.push_back(path);
  }
  if (runs.empty())
    throw Error(ExitCode::bad_data, fmt::format("none of these {} files is a run", paths.size()));
  return runs;
}

}  // namespace talus::app
