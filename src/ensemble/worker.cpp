#include "ensemble/worker.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <ctime>
#include <filesystem>
#include <fmt/core.h>
#include <map>
#include <numeric>
#include <set>
#include <system_error>
#include <thread>

#include "base/child_program.h"
#include "base/errors.h"
#include "base/locked_file.h"
#include "base/output_file.h"
#include "base/text.h"
#include "ensemble/slurm.h"
#include "io/packed_file.h"
#include "io/run_folder.h"
#include "io/run_store.h"

namespace talus::ensemble {

namespace {

using Clock = std::chrono::steady_clock;

/// State of a worker.
struct Worker {
  const WorkerOptions& options;
  ClaimWatch watch;
  std::map<std::string, std::string> waits_for = {};  ///< last reported writer of the run of each member
  std::set<std::string> refused = {};                 ///< members that have ended once with exit code 73
  KnownMembers known = {};
  Clock::time_point begin = Clock::now();
  WorkerEnd end = {};
};

/// Returns the members by descending estimated time; equal times keep the order of the plan.
std::vector<std::size_t> longest_first(const EnsemblePlan& plan) {
  const std::vector<double> variant_seconds = estimated_seconds(plan);
  std::vector<std::size_t> order(plan.members.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::greater<>(),
                           [&](std::size_t m) { return variant_seconds[plan.members[m].variant]; });
  return order;
}

/// Whether a newly acquired claim is valid, for a member that still has to be computed.
bool is_valid_claim(const EnsemblePlan& plan, std::size_t member, const Claim& claim) {
  const MemberState now = scan_members(plan)[member];
  return now.stage == MemberStage::claimed && now.claim == claim.number();
}

/// Whether another process writes the run of a member, such as `talus run --resume`, or a process whose
/// worker was considered dead. Reports each new writer.
bool is_written(const Member& member, Worker& worker) {
  const std::string writer = io::writer_of(io::run_folder(member.path));
  if (writer.empty()) {
    worker.waits_for.erase(member.name);
    return false;
  }
  std::string& reported = worker.waits_for[member.name];
  if (reported != writer && worker.options.on_wait) worker.options.on_wait(member.name, writer);
  reported = writer;
  return true;
}

/// The result of scanning all members.
struct Scan {
  std::optional<Claim> claim;      ///< claim on a member, if there was one to begin
  const Member* member = nullptr;  ///< this member of the plan
  std::size_t alive = 0;
  std::size_t unknown = 0;  ///< claims that must be watched for longer
  std::size_t written = 0;  ///< members whose runs other processes write, to be awaited
};

Scan claim_next(const EnsemblePlan& plan, const std::vector<MemberState>& states, Worker& worker) {
  Scan scan;
  for (const std::size_t m : longest_first(plan)) {
    const Member& member = plan.members[m];
    const MemberState& state = states[m];
    if (!worker.options.only.empty() && member.name != worker.options.only) continue;
    if (state.stage == MemberStage::done || state.stage == MemberStage::failed) continue;
    if (state.claim) {
      const ClaimState claim = claim_state(member.path, *state.claim, worker.watch);
      if (claim == ClaimState::alive) ++scan.alive;
      if (claim == ClaimState::unknown) ++scan.unknown;
      if (claim != ClaimState::dead) continue;
    }
    if (is_written(member, worker)) {
      ++scan.written;
      continue;
    }
    std::optional<Claim> claim = Claim::take(member.path, state.claim, worker.options.times);
    if (!claim || !is_valid_claim(plan, m, *claim)) continue;
    scan.claim.emplace(std::move(*claim));
    scan.member = &member;
    return scan;
  }
  return scan;
}

/// Returns the remaining time of the worker, formatted for talus; nothing without a limit.
std::optional<std::string> time_left(const Worker& worker) {
  if (!worker.options.max_wall) return std::nullopt;
  const double left =
      *worker.options.max_wall - std::chrono::duration<double>(Clock::now() - worker.begin).count();
  if (left < 1.0) throw Error(ExitCode::stopped, "the worker was stopped for --max-wall");
  return time_text(left);
}

/// Computes and analyses the member in another process, and keeps the claim alive meanwhile.
void compute(Worker& worker, const Member& member, Claim& claim) {
  std::vector<std::string> arguments = {"ensemble", "member", path_word(worker.options.folder),
                                        path_word(member.name)};
  if (const std::optional<std::string> left = time_left(worker)) {
    arguments.emplace_back("--max-wall");
    arguments.push_back(*left);
  }
  if (worker.options.on_change) worker.options.on_change(member.name, -1);
  bool lost = false;
  const auto keep_claim = [&] { return !(lost = lost || !claim.record_heartbeat()); };
  const std::vector<FailedJob> failed =
      run_jobs({{std::move(arguments), path_with_extension(member.path, ".log")}}, "the worker", keep_claim);
  const int code = failed.empty() ? 0 : failed.front().exit_code;
  // Another worker continues the member, so that the error of a process that was considered dead does not
  // count as a failure.
  if (lost || (code != 0 && !claim.record_heartbeat())) return;
  if (worker.options.on_change) worker.options.on_change(member.name, code);
  if (code == static_cast<int>(ExitCode::stopped))
    throw Error(ExitCode::stopped,
                "the worker was stopped; the members under way resume from their checkpoints");
  if (code == 0) {
    ++worker.end.done;
    return;
  }
  // Another process was writing the run, perhaps one whose worker was considered dead; the first time does
  // not count as a failure either.
  if (code == static_cast<int>(ExitCode::cannot_create) && worker.refused.insert(member.name).second) return;
  // A signal to all processes of a job also ends this worker, perhaps a moment after its member. In that case
  // the member has not failed.
  if (code > 128) std::this_thread::sleep_for(std::chrono::seconds(1));
  record_failure(member.path, {code, failed.front().message});
  ++worker.end.failed;
}

}  // namespace

bool has_work(const EnsemblePlan& plan, const std::vector<MemberState>& states, ClaimWatch& watch) {
  for (std::size_t m = 0; m < states.size(); ++m) {
    if (states[m].stage == MemberStage::waiting) return true;
    if (states[m].stage == MemberStage::claimed &&
        claim_state(plan.members[m].path, *states[m].claim, watch) == ClaimState::dead)
      return true;
  }
  return false;
}

WorkerEnd work_on_ensemble(const WorkerOptions& options) {
  Worker worker{options, {options.times, {}}};
  for (;;) {
    const EnsembleManifest manifest = read_ensemble(options.folder);
    const EnsemblePlan plan = plan_of(manifest, options.folder);
    std::vector<MemberState> states = scan_members(plan);
    if (!manifest.until.empty()) find_damage(plan, states, worker.known);
    worker.end.enough = !manifest.until.empty() && is_reached(parse_precision(manifest.until), plan,
                                                              numbers_of(plan, states, worker.known));
    if (worker.end.enough) return worker.end;
    Scan scan = claim_next(plan, states, worker);
    worker.end.elsewhere = scan.alive + scan.unknown + scan.written;
    if (scan.claim)
      compute(worker, *scan.member, *scan.claim);
    else if (scan.unknown + scan.written == 0)
      return worker.end;
    else {
      time_left(worker);  // throws when the time is over
      std::this_thread::sleep_for(std::chrono::milliseconds(200));
    }
  }
}

namespace {

/// Blocks the signals that run_jobs waits for during its lifetime.
class HeldSignals {
 public:
  HeldSignals() {
    sigemptyset(&held_);
    for (const int signal : {SIGINT, SIGTERM, SIGCHLD}) sigaddset(&held_, signal);
    struct sigaction hangup = {};  // nohup ignores it
    if (sigaction(SIGHUP, nullptr, &hangup) != 0 || hangup.sa_handler != SIG_IGN) sigaddset(&held_, SIGHUP);
    sigprocmask(SIG_BLOCK, &held_, &before_);
  }
  ~HeldSignals() { sigprocmask(SIG_SETMASK, &before_, nullptr); }
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;

  /// Returns the next signal, whose number is 0 after half a second without one.
  siginfo_t wait() const {
    constexpr timespec half_a_second = {0, 500'000'000};
    siginfo_t signal{};
    if (sigtimedwait(&held_, &signal, &half_a_second) < 0) signal.si_signo = 0;
    return signal;
  }

 private:
  sigset_t held_;
  sigset_t before_;
};

pid_t start(const Job& job) {
  const Descriptor log(open(job.log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666));
  if (log.get() < 0) throw creation_error("open", job.log, errno);
  const pid_t process = start_this_program(job.arguments, {.in = -1, .out = log.get(), .err = log.get()});
  if (process < 0) throw system_error(ExitCode::io_error, "start a process for", job.log, errno);
  return process;
}

/// Returns the last line of a job. On a full disk its log has none, and the exit code indicates the reason.
std::string last_message_in(const std::string& log, int code) {
  std::string message;
  try {
    message = last_line_of(log);
  } catch (const Error&) {  // the log no longer exists
  }
  if (!message.empty() || code != static_cast<int>(ExitCode::io_error)) return message;
  std::error_code unknown;
  const std::filesystem::space_info space = std::filesystem::space(parent_folder(log), unknown);
  return !unknown && space.available < 65536 ? "no space left on the disk of this folder"
                                             : "a file could not be read or written";
}

/// Removes the jobs that have ended from `running`; those with an error are added to `failed`.
void collect(std::map<pid_t, const Job*>& running, std::vector<FailedJob>& failed) {
  for (auto child = running.begin(); child != running.end();) {
    int status = 0;
    const pid_t ended = waitpid(child->first, &status, WNOHANG);
    if (ended == 0 || (ended < 0 && errno == EINTR)) {
      ++child;
      continue;
    }
    // Without a status (another process has collected it), the outcome is unknown.
    const int ended_with = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    const int code = ended < 0 ? static_cast<int>(ExitCode::internal) : ended_with;
    if (code != 0) failed.push_back({child->second->log, code, last_message_in(child->second->log, code)});
    child = running.erase(child);
  }
}

/// Returns the exit code for a process that ended with `code`. A signal from outside, such as that of the
/// system where memory runs out, is no defect of the program.
ExitCode exit_code_after(int code) {
  if (code <= 128) return static_cast<ExitCode>(code);
  constexpr std::array crashes = {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGTRAP, SIGSYS};
  const bool crashed = std::ranges::find(crashes, code - 128) != crashes.end();
  return crashed ? ExitCode::internal : ExitCode::stopped;
}

/// Describes the end of a process that a signal from outside has ended; empty for any other.
std::string killed_text(int code) {
  if (code <= 128 || exit_code_after(code) == ExitCode::internal) return "";
  return fmt::format(", killed by signal {}{}", code - 128,
                     code == 128 + SIGKILL ? ", as by the system where memory runs out" : "");
}

}  // namespace

std::vector<FailedJob> run_jobs(const std::vector<Job>& jobs, const std::string& work,
                                const std::function<bool()>& should_continue) {
  for (const Job& job : jobs) {
    prepare_folder_of(job.log);
    output_target(job.log);  // opening a FIFO would block
  }
  const HeldSignals signals;
  std::map<pid_t, const Job*> running;
  std::vector<FailedJob> failed;
  for (const Job& job : jobs) running.emplace(start(job), &job);
  bool given_up = false;
  std::optional<Clock::time_point> stopped;
  const auto end_all = [&](StopRequest request) {
    for (const auto& [process, job] : running) pass_on_stop(process, request);
  };
  while (!running.empty()) {
    if (!stopped && !given_up && !should_continue()) {
      given_up = true;
      end_all(StopRequest::once);
    }
    if (const siginfo_t signal = signals.wait(); signal.si_signo != 0 && signal.si_signo != SIGCHLD) {
      const bool repeats =
          stopped && std::chrono::duration<double>(Clock::now() - *stopped).count() >= repeats_end;
      const StopRequest own = repeats ? StopRequest::at_once : StopRequest::once;
      end_all(passed_on(signal).value_or(own));
      if (!stopped) stopped = Clock::now();
    }
    collect(running, failed);
  }
  if (stopped) throw Error(ExitCode::stopped, "{} was stopped; repeat the command to continue", work);
  return failed;
}

void refuse(const std::vector<FailedJob>& failed, const std::string& consequence) {
  std::string text = fmt::format("{}{} ended with an error, {}; see", failed.size(),
                                 failed.size() == 1 ? " run" : " runs", consequence);
  for (const auto& [log, exit_code, message] : failed)
    text += fmt::format("\n  {} (exit code {}{}){}{}", log, exit_code, killed_text(exit_code),
                        message.empty() ? "" : ": ", message);
  throw Error(exit_code_after(failed.front().exit_code), text);
}

std::string path_word(const std::string& path) { return path.starts_with('-') ? "./" + path : path; }

/// Returns the number of runs that are kept; nothing means all.
static std::optional<std::size_t> kept_count(const std::string& keep) {
  if (keep.empty() || keep == "all") return std::nullopt;
  if (keep == "analysis") return 0;
  if (const auto number = parse_number<std::size_t>(keep)) return number;
  throw Error(ExitCode::usage,
              "--keep {}: expected all, analysis, or the number of seeds whose runs are kept",
              visible_word(keep));
}

/// Removes the folder of a packed run unless another process uses it; a folder that remains is harmless.
static void discard_packed(const std::string& run) try {
  if (io::run_presence(run) == io::RunPresence::packed) io::discard_folder(run);
} catch (const Error& error) {
  if (error.code() != ExitCode::cannot_create) throw;
}

void check_keep(const std::string& keep) { kept_count(keep); }

bool keeps_frames(const EnsembleManifest& manifest, std::uint64_t seed) {
  const std::optional<std::size_t> kept = kept_count(manifest.keep);
  if (!kept) return true;
  const auto before = std::ranges::lower_bound(manifest.seeds, seed) - manifest.seeds.begin();
  return static_cast<std::size_t>(before) < *kept;
}

bool is_in_folder(const Member& member, const std::string& folder) {
  return resolved_path(member.path).starts_with(resolved_path(folder) + "/");
}

std::size_t drop_frames(const EnsembleManifest& manifest, const EnsemblePlan& plan, const std::string& folder,
                        KnownMembers& known) {
  if (!kept_count(manifest.keep)) return 0;
  std::size_t dropped = 0;
  for (const std::size_t m : done_members(plan)) {
    const Member& member = plan.members[m];
    if (keeps_frames(manifest, member.seed) || !is_in_folder(member, folder)) continue;
    try {
      const MemberResult& result = analysed_member(member, known);
      if (!result.has_frames) continue;
      const std::optional<analysis::Analysis> analysis = io::read_analysis(member.path);
      if (!analysis) continue;
      io::store_analysis(member.path, *analysis, result.numbers.state_hash, analysis::quantities(), false);
      ++dropped;
    } catch (const Error&) {
      continue;  // it is reported with the averages
    }
  }
  return dropped;
}

void drop_leftovers(const EnsemblePlan& plan) {
  const std::vector<MemberState> states = scan_members(plan);
  for (std::size_t m = 0; m < states.size(); ++m) {
    const std::string& path = plan.members[m].path;
    if (states[m].stage == MemberStage::done && states[m].has_folder) discard_packed(path);
    if (!states[m].claim) continue;
    if (states[m].stage != MemberStage::done && states[m].stage != MemberStage::failed) continue;
    for (const std::string& claim : claims_of(path))
      if (!is_locked(claim).value_or(false)) ::unlink(claim.c_str());
  }
}

}  // namespace talus::ensemble
