#include "ensemble/pool.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <ctime>
#include <fmt/core.h>
#include <map>

#include "core/errors.h"
#include "core/output_file.h"
#include "io/run_file.h"
#include "session/run_header.h"

namespace talus {
namespace {

/// The signals that run_jobs waits for, kept from being delivered while it lives.
class HeldSignals {
 public:
  HeldSignals() {
    sigemptyset(&held_);
    for (const int signal : {SIGINT, SIGTERM, SIGCHLD}) sigaddset(&held_, signal);
    struct sigaction hangup = {};  // ignored by nohup
    if (sigaction(SIGHUP, nullptr, &hangup) != 0 || hangup.sa_handler != SIG_IGN) sigaddset(&held_, SIGHUP);
    sigprocmask(SIG_BLOCK, &held_, &before_);
  }
  ~HeldSignals() { sigprocmask(SIG_SETMASK, &before_, nullptr); }
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;

  /// The next of them, or -1 after half a second without one.
  int wait() const {
    constexpr timespec half_a_second = {0, 500'000'000};
    return sigtimedwait(&held_, nullptr, &half_a_second);
  }
  const sigset_t& before() const { return before_; }

 private:
  sigset_t held_;
  sigset_t before_;
};

/// Between fork and exec: only calls that are safe there.
[[noreturn]] void become(const char* log, char* const* arguments, pid_t parent, const sigset_t& signals) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(static_cast<int>(ExitCode::stopped));
  // Ctrl-C reaches the whole foreground group: the child leaves it, so that it is asked to stop only once.
  setpgid(0, 0);
  sigprocmask(SIG_SETMASK, &signals, nullptr);
  const int out = open(log, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  const int in = open("/dev/null", O_RDONLY | O_CLOEXEC);
  if (out < 0 || in < 0) _exit(static_cast<int>(ExitCode::cannot_create));
  dup2(in, STDIN_FILENO);
  dup2(out, STDOUT_FILENO);
  dup2(out, STDERR_FILENO);
  // This very program, even where its file has been replaced since.
  execv("/proc/self/exe", arguments);
  _exit(static_cast<int>(ExitCode::internal));
}

pid_t start(const Job& job, const sigset_t& signals) {
  std::vector<std::string> words = {"talus"};
  words.insert(words.end(), job.arguments.begin(), job.arguments.end());
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const pid_t parent = getpid();
  const pid_t process = fork();
  if (process == 0) become(job.log.c_str(), arguments.data(), parent, signals);
  if (process < 0) throw system_error(ExitCode::io_error, "start a process for", job.log, errno);
  return process;
}

/// Takes the jobs out of `running` that have ended; those with an error go to `failed`.
void collect(std::map<pid_t, const Job*>& running, std::vector<FailedJob>& failed) {
  for (auto child = running.begin(); child != running.end();) {
    int status = 0;
    if (waitpid(child->first, &status, WNOHANG) != child->first) {
      ++child;
      continue;
    }
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    if (code != 0) failed.push_back({child->second->log, code});
    child = running.erase(child);
  }
}

}  // namespace

std::vector<FailedJob> run_jobs(const std::vector<Job>& jobs, const std::string& work,
                                const std::function<bool()>& go_on) {
  for (const Job& job : jobs) {
    prepare_folder_of(job.log);
    output_target(job.log);  // a FIFO would wait for somebody to read it
  }
  const HeldSignals signals;
  std::map<pid_t, const Job*> running;
  std::vector<FailedJob> failed;
  for (const Job& job : jobs) running.emplace(start(job, signals.before()), &job);
  bool stopped = false, given_up = false;
  const auto end_all = [&] {
    for (const auto& [process, job] : running) kill(process, SIGTERM);
  };
  while (!running.empty()) {
    if (!stopped && !given_up && !go_on()) {
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
  for (const auto& [log, exit_code, said] : failed)
    text += fmt::format("\n  {} (exit code {}){}{}", log, exit_code, said.empty() ? "" : ": ", said);
  const int code = failed.front().exit_code;
  throw Error(code > 128 ? ExitCode::internal : static_cast<ExitCode>(code), text);
}

bool is_complete(const Member& member) {
  const RunPresence presence = run_presence(member.path);
  if (presence == RunPresence::none) return false;
  // Values are compared, not texts: a key that an earlier version did not have is at its default in it.
  if (stored_scenario(RunFile::open(member.path).header(), member.path) != member.scenario)
    throw Error(ExitCode::bad_data,
                fmt::format("{} is a run of another scenario than this ensemble's; expected the scenario, "
                            "the settings and the version that the ensemble began with; give another folder",
                            member.path));
  return presence == RunPresence::packed;
}

std::string path_word(const std::string& path) { return path.starts_with('-') ? "./" + path : path; }

}  // namespace talus
