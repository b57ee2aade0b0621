#include "ensemble/claim.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <filesystem>
#include <fmt/core.h>
#include <limits>
#include <system_error>

#include "base/errors.h"
#include "base/locked_file.h"
#include "base/output_file.h"
#include "base/paths.h"
#include "ensemble/plan.h"

namespace talus::ensemble {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* infix = ".claim-";

/// Returns the boot id of this machine; all its processes share it, also in containers.
std::string this_boot() {
  const Descriptor file(::open("/proc/sys/kernel/random/boot_id", O_RDONLY | O_CLOEXEC));
  std::array<std::byte, 64> text{};
  const std::size_t size = file.get() < 0 ? 0 : read_at_most(file, text, "/proc/sys/kernel/random/boot_id");
  std::string boot(reinterpret_cast<const char*>(text.data()), size);
  return boot.substr(0, boot.find('\n'));
}

/// Returns the first line of a claim; each heartbeat appends one byte after it.
std::string line_of_claim() {
  std::array<char, 256> host{};
  ::gethostname(host.data(), host.size() - 1);
  return fmt::format("process {} on host {}, boot {}\n", ::getpid(), host.data(), this_boot());
}

constexpr int last_number = std::numeric_limits<int>::max();

/// Returns the number of the claim that replaces a dead one. After the last number, it is the lowest free
/// one.
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
  const char* const digits = file.data() + at + std::char_traits<char>::length(infix);
  const char* const last = file.data() + file.size();
  ClaimName name{file.substr(0, at), 0};
  const auto [end, error] = std::from_chars(digits, last, name.number);
  // Accept only the spelling of claim_path; another spelling belongs to another file.
  if (error != std::errc() || end != last || name.number < 0 || std::to_string(name.number) != digits)
    return std::nullopt;
  return name;
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

Claim::Claim(std::string path, int number, std::string next, Descriptor file, double seconds)
    : path_(std::move(path)),
      number_(number),
      next_(std::move(next)),
      file_(std::move(file)),
      interval_(seconds),
      last_(Clock::now()) {}

std::optional<Claim> Claim::take(const std::string& run, std::optional<int> found, const ClaimTimes& times) {
  const int number = number_after(run, found);
  const std::string path = claim_path(run, number);
  // The processes that compute the member inherit the lock, so that the claim lives as long as any of them.
  Descriptor file(::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_APPEND, 0666));
  if (file.get() < 0 && errno == EEXIST) return std::nullopt;
  if (file.get() < 0) throw creation_error("create", path, errno);
  ::flock(file.get(), LOCK_EX | LOCK_NB);  // for this machine; other machines rely on heartbeats
  Claim claim(path, number, claim_path(run, number_after(run, number)), std::move(file),
              times.heartbeat_interval());
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
  std::error_code unknown;
  if (!is_named(path_, file_) || std::filesystem::exists(next_, unknown)) return false;
  if (Clock::now() - last_ < interval_) return true;
  last_ = Clock::now();
  // A full disk must not end a member that is being computed.
  if (::write(file_.get(), ".", 1) == 1) ::fdatasync(file_.get());
  return true;
}

}  // namespace talus::ensemble
