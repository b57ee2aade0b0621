#include "ensemble/pool.h"

#include <fcntl.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <ctime>
#include <filesystem>
#include <fmt/core.h>
#include <map>
#include <optional>
#include <system_error>

#include "base/child_program.h"
#include "base/descriptor.h"
#include "base/errors.h"
#include "base/output_file.h"
#include "base/visible_text.h"
#include "ensemble/member_state.h"

namespace talus::ensemble {
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

bool asks_to_stop(const siginfo_t& signal) {
  return signal.si_signo == SIGINT || signal.si_signo == SIGTERM || signal.si_signo == SIGHUP;
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
  using Clock = std::chrono::steady_clock;
  std::optional<Clock::time_point> stopped;
  const auto end_all = [&](StopRequest request) {
    for (const auto& [process, job] : running) pass_on_stop(process, request);
  };
  while (!running.empty()) {
    if (!stopped && !given_up && !should_continue()) {
      given_up = true;
      end_all(StopRequest::once);
    }
    if (const siginfo_t signal = signals.wait(); asks_to_stop(signal)) {
      const bool repeats =
          stopped && std::chrono::duration<double>(Clock::now() - *stopped).count() >= repeats_end;
      const StopRequest own = repeats ? StopRequest::at_once : StopRequest::once;
      end_all(passed_on(signal).value_or(own));
      if (!stopped) stopped = Clock::now();
    }
    collect(running, failed);
  }
  if (stopped)
    throw Error(ExitCode::stopped, fmt::format("{} was stopped; repeat the command to continue", work));
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

}  // namespace talus::ensemble
