#include "ensemble/member_state.h"

#include <algorithm>
#include <filesystem>
#include <fmt/core.h>
#include <map>
#include <set>

#include "base/errors.h"
#include "base/text_stream.h"
#include "base/visible_text.h"
#include "ensemble/claim.h"
#include "io/durable_file.h"

namespace talus::ensemble {
namespace {

namespace fs = std::filesystem;

constexpr const char* old_table_ending = ".csv";
constexpr const char* failure_ending = ".failed";
constexpr const char* run_ending = ".h5";
constexpr const char* folder_ending = ".h5.run";

constexpr const char* endings[] = {run_ending, folder_ending, failure_ending, old_table_ending};

/// The members found in one folder, by the names of their runs without extension.
struct FolderNames {
  std::set<std::string> files;
  std::map<std::string, int> claims;  ///< highest claim of each run
};

FolderNames members_named_in(const fs::path& folder) {
  FolderNames names;
  std::error_code error, unknown;  // a folder that does not exist has no members yet
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const std::string file = entry->path().filename().string();
    if (const std::optional<ClaimName> claim = parse_claim_name(file)) {
      int& highest = names.claims.try_emplace(claim->run, claim->number).first->second;
      highest = std::max(highest, claim->number);
    } else if (file.ends_with(run_ending) && !entry->is_regular_file(unknown)) {
      continue;  // not a run file
    } else if (std::ranges::any_of(endings, [&](const char* ending) { return file.ends_with(ending); })) {
      names.files.insert(file);
    }
  }
  return names;
}

MemberState state_of(const FolderNames& names, const std::string& run) {
  MemberState state;
  state.has_folder = names.files.contains(run + folder_ending);
  state.has_old_table = names.files.contains(run + old_table_ending);
  if (const auto claim = names.claims.find(run); claim != names.claims.end()) state.claim = claim->second;
  if (names.files.contains(run + run_ending))
    state.stage = MemberStage::done;
  else if (names.files.contains(run + failure_ending))
    state.stage = MemberStage::failed;
  else if (state.claim)
    state.stage = MemberStage::claimed;
  return state;
}

}  // namespace

std::vector<MemberState> scan_members(const EnsemblePlan& plan) {
  std::map<std::string, FolderNames> folders;
  std::vector<MemberState> states;
  states.reserve(plan.members.size());
  for (const Member& member : plan.members) {
    const fs::path path = member.path;
    const std::string folder = path.parent_path().string();
    auto found = folders.find(folder);
    if (found == folders.end()) found = folders.emplace(folder, members_named_in(folder)).first;
    states.push_back(state_of(found->second, path.stem().string()));
  }
  return states;
}

std::vector<std::size_t> done_members(const EnsemblePlan& plan) {
  const std::vector<MemberState> states = scan_members(plan);
  std::vector<std::size_t> done;
  for (std::size_t m = 0; m < states.size(); ++m)
    if (states[m].stage == MemberStage::done) done.push_back(m);
  return done;
}

std::size_t count_of(const std::vector<MemberState>& states, MemberStage stage) {
  return static_cast<std::size_t>(std::ranges::count(states, stage, &MemberState::stage));
}

std::string failure_path(const std::string& run) { return path_with_extension(run, failure_ending); }

void record_failure(const std::string& run, const MemberFailure& failure) {
  io::write_text(failure_path(run), fmt::format("exit code {}\n{}\n", failure.exit_code, failure.message));
}

MemberFailure read_failure(const std::string& run) {
  std::istringstream lines = text_stream(io::read_text(failure_path(run)));
  MemberFailure failure;
  std::string word;
  lines >> word >> word >> failure.exit_code;
  std::getline(lines, failure.message);
  std::getline(lines, failure.message);
  failure.message = visible(failure.message);
  // A member with such a file has failed, whatever the file contains.
  if (failure.exit_code < 1 || failure.exit_code > 255)
    return {
        static_cast<int>(ExitCode::bad_data),
        visible(failure_path(run)) + " is not in the form that talus writes; the member's error is unknown"};
  return failure;
}

std::string last_line_of(const std::string& log) {
  std::istringstream lines = text_stream(io::read_text(log));
  std::string last;
  for (std::string line; std::getline(lines, line);)
    if (line.find_first_not_of(" \r\t") != std::string::npos) last = visible(line);
  return last;
}

}  // namespace talus::ensemble
