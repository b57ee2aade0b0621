#include "app/child_runs.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <ctime>
#include <map>

#include "core/errors.h"

namespace talus {
namespace {

/// The signals that run_children waits for, kept from being delivered while it lives.
class HeldSignals {
 public:
  HeldSignals() {
    sigemptyset(&held_);
    for (const int signal : {SIGINT, SIGTERM, SIGCHLD}) sigaddset(&held_, signal);
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

pid_t start(const ChildRun& child, const sigset_t& signals) {
  std::vector<std::string> words = {"talus"};
  words.insert(words.end(), child.arguments.begin(), child.arguments.end());
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const pid_t parent = getpid();
  const pid_t process = fork();
  if (process == 0) become(child.log.c_str(), arguments.data(), parent, signals);
  if (process < 0) throw system_error(ExitCode::io_error, "start a process for", child.log, errno);
  return process;
}

using Running = std::map<pid_t, std::size_t>;

/// Takes the children out of `running` that have ended.
void collect(Running& running, const ChildEvents& events) {
  for (auto child = running.begin(); child != running.end();) {
    int status = 0;
    if (waitpid(child->first, &status, WNOHANG) != child->first) {
      ++child;
      continue;
    }
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    if (events.on_end) events.on_end(child->second, code);
    child = running.erase(child);
  }
}

}  // namespace

bool run_children(const std::vector<ChildRun>& children, int at_once, const ChildEvents& events) {
  const HeldSignals signals;
  Running running;
  std::size_t next = 0;
  bool stopped = false;
  while (!running.empty() || (!stopped && next < children.size())) {
    while (!stopped && next < children.size() && running.size() < static_cast<std::size_t>(at_once)) {
      running.emplace(start(children[next], signals.before()), next);
      if (events.on_start) events.on_start(next);
      ++next;
    }
    const int signal = signals.wait();
    if (signal == SIGINT || signal == SIGTERM) {
      stopped = true;
      for (const auto& [process, child] : running) kill(process, SIGTERM);
    }
    collect(running, events);
    if (events.on_wait) events.on_wait();
  }
  return !stopped;
}

}  // namespace talus
