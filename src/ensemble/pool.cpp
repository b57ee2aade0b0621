#include "ensemble/pool.h"

#include <fcntl.h>
#include <sys/wait.h>

#include <cerrno>
#include <csignal>
#include <ctime>
#include <filesystem>
#include <fmt/core.h>
#include <map>
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

  /// Returns the next signal, or -1 after half a second without one.
  int wait() const {
    constexpr timespec half_a_second = {0, 500'000'000};
    return sigtimedwait(&held_, nullptr, &half_a_second);
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
  bool stopped = false, given_up = false;
  const auto end_all = [&] {
    for (const auto& [process, job] : running) kill(process, SIGTERM);
  };
  while (!running.empty()) {
    if (!stopped && !given_up && !should_continue()) {
      given_up = true;
      end_all();
    }
    const int signal = signals.wait();
    if (signal == SIGINT || signal == SIGTERM || signal == SIGHUP) {
      stopped = true;
      end_all();
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
    text += fmt::format("\n  {} (exit code {}){}{}", log, exit_code, message.empty() ? "" : ": ", message);
  const int code = failed.front().exit_code;
  throw Error(code > 128 ? ExitCode::internal : static_cast<ExitCode>(code), text);
}

std::string path_word(const std::string& path) { return path.starts_with('-') ? "./" + path : path; }

}  // namespace talus::ensemble
