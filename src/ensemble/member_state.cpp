#include "ensemble/member_state.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <fmt/core.h>
#include <fstream>
#include <limits>
#include <set>
#include <system_error>

#include "base/errors.h"
#include "base/locked_file.h"
#include "base/text.h"
#include "io/durable_file.h"
#include "io/run_folder.h"

namespace talus::ensemble {

namespace {

namespace fs = std::filesystem;

constexpr const char* failure_ending = ".failed";
constexpr const char* run_ending = ".h5";
constexpr const char* folder_ending = ".h5.run";

/// The files of one folder, and the claims by the names of their runs without extension.
struct FolderNames {
  std::set<std::string> files;        ///< those called like runs are regular files
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
    } else if (!file.ends_with(run_ending) || entry->is_regular_file(unknown)) {
      names.files.insert(file);
    }
  }
  return names;
}

MemberState state_of(const FolderNames& names, const std::string& run) {
  MemberState state;
  state.has_folder = names.files.contains(run + folder_ending);
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
  std::string last;
  for (const std::string& line : lines_of(io::read_text(log)))
    if (line.find_first_not_of(" \r\t") != std::string::npos) last = visible(line);
  return last;
}

namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* infix = ".claim-";

/// Returns the boot id of this machine; all its processes share it, also in containers.
std::string this_boot() {
  std::string boot;
  std::ifstream("/proc/sys/kernel/random/boot_id") >> boot;
  return boot;
}

/// Returns the first line of a claim; each heartbeat appends one byte after it.
std::string line_of_claim() { return fmt::format("{}, boot {}\n", io::this_process(), this_boot()); }

constexpr double heartbeats = 12.0;  // in the time after which a claim is dead
constexpr int last_number = std::numeric_limits<int>::max();

/// Returns the number of the claim that replaces a dead one. At last it is the lowest free one.
int number_after(const std::string& run, std::optional<int> found) {
  if (!found) return 0;
  if (*found < last_number) return *found + 1;
  int number = 0;
  while (is_there(claim_path(run, number))) ++number;
  return number;
}

}  // namespace

std::string claim_path(const std::string& run, int number) {
  return path_with_extension(run, fmt::format("{}{}", infix, number).c_str());
}

std::optional<ClaimName> parse_claim_name(const std::string& file) {
  const std::size_t at = file.rfind(infix);
  if (at == std::string::npos) return std::nullopt;
  const std::string digits = file.substr(at + std::char_traits<char>::length(infix));
  const int number = parse_number<int>(digits).value_or(-1);
  // Accept only the spelling of claim_path; another spelling belongs to another file.
  if (number < 0 || std::to_string(number) != digits) return std::nullopt;
  return ClaimName{file.substr(0, at), number};
}

std::vector<std::string> claims_of(const std::string& run) {
  const std::filesystem::path path = run;
  std::vector<std::string> claims;
  std::error_code unknown;
  for (const std::string& file : names_in(parent_folder(run), unknown))
    if (const auto name = parse_claim_name(file); name && name->run == path.stem().string())
      claims.push_back(claim_path(run, name->number));
  return claims;
}

std::optional<ClaimHolder> read_claim(const std::string& run, int number) {
  const std::string path = claim_path(run, number);
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  struct stat status {};
  if (file.get() < 0 || ::fstat(file.get(), &status) != 0) return std::nullopt;
  std::array<std::byte, 512> bytes{};
  const std::size_t size = read_at_most(file, bytes, path);
  const std::string text(reinterpret_cast<const char*>(bytes.data()), size);
  const std::size_t line = text.find('\n'), boot = text.find(", boot ");
  if (line == std::string::npos || boot == std::string::npos || boot > line) return std::nullopt;
  return ClaimHolder{text.substr(0, boot), text.substr(boot + 7, line - boot - 7),
                     static_cast<std::uint64_t>(status.st_size) - line - 1};
}

ClaimState claim_state(const std::string& run, int number, ClaimWatch& watch) {
  const std::optional<ClaimHolder> holder = read_claim(run, number);
  if (holder && holder->boot == this_boot())
    // Without locks, heartbeats also decide on this machine.
    if (const std::optional<bool> held = is_locked(claim_path(run, number)))
      return *held ? ClaimState::alive : ClaimState::dead;
  const std::uint64_t beats = holder ? holder->beats : 0;
  const std::string who = holder ? holder->worker + holder->boot : "";
  auto [found, is_new] = watch.observations.try_emplace(run);
  ClaimWatch::Observation& observation = found->second;
  const bool is_same = !is_new && observation.number == number && (observation.who == who || !holder);
  if (!is_same || beats > observation.beats) observation = {number, beats, Clock::now(), is_same, who};
  if (std::chrono::duration<double>(Clock::now() - observation.since).count() >= watch.times.stale)
    return ClaimState::dead;
  return observation.grew ? ClaimState::alive : ClaimState::unknown;
}

Claim::Claim(const std::string& run, int number, Descriptor file, const ClaimTimes& times)
    : path_(claim_path(run, number)),
      number_(number),
      next_(claim_path(run, number_after(run, number))),
      file_(std::move(file)),
      interval_(times.stale / heartbeats) {}

std::optional<Claim> Claim::take(const std::string& run, std::optional<int> found, const ClaimTimes& times) {
  const int number = number_after(run, found);
  const std::string path = claim_path(run, number);
  // The processes that compute the member inherit the lock, so that the claim lives as long as any of them.
  Descriptor file(::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_APPEND, 0666));
  if (file.get() < 0 && errno == EEXIST) return std::nullopt;
  if (file.get() < 0) throw creation_error("create", path, errno);
  ::flock(file.get(), LOCK_EX | LOCK_NB);  // for this machine; other machines rely on heartbeats
  Claim claim(run, number, std::move(file), times);
  const std::string text = line_of_claim();
  if (::write(claim.file_.get(), text.data(), text.size()) != static_cast<ssize_t>(text.size()))
    throw system_error(ExitCode::io_error, "write", path, errno);
  ::fdatasync(claim.file_.get());  // lets other machines see it sooner; a failure is harmless
  // If the dead claim has disappeared, another process has replaced it, and this number is too high.
  if (found && ::unlink(claim_path(run, *found).c_str()) != 0) return std::nullopt;
  return claim;
}

Claim::~Claim() {
  if (file_.get() >= 0 && is_named(path_, file_)) ::unlink(path_.c_str());
}

bool Claim::record_heartbeat() {
  if (!is_named(path_, file_) || is_there(next_)) return false;
  if (Clock::now() - last_ < interval_) return true;
  last_ = Clock::now();
  // A full disk must not end a member that is being computed.
  if (::write(file_.get(), ".", 1) == 1) ::fdatasync(file_.get());
  return true;
}

}  // namespace talus::ensemble
