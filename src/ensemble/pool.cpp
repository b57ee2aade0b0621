#include "ensemble/pool.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <ctime>
#include <fmt/core.h>
#include <map>

#include "core/errors.h"
#include "core/output_file.h"
#include "io/run_file.h"
#include "session/estimate.h"
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

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

struct Running {
  const Job* job;
  Clock::time_point since;
};

/// Jobs on their way.
struct Pool {
  const std::vector<Job>& jobs;
  const PoolOptions& options;
  std::size_t next = 0;  ///< job to be started
  std::map<pid_t, Running> running = {};
  std::vector<FailedJob> failed = {};
  std::size_t done = 0;
  double estimate_of_done = 0.0;  ///< s
  double seconds_of_done = 0.0;   ///< s, what these really took
  Clock::time_point begin = Clock::now();
};

/// Jobs that ended tell how far the estimates are off; those under way count with what is left of them.
double seconds_left(const Pool& pool) {
  const double pace = pool.estimate_of_done > 0.0 ? pool.seconds_of_done / pool.estimate_of_done : 1.0;
  double left = 0.0, longest = 0.0;
  for (std::size_t k = pool.next; k < pool.jobs.size(); ++k) left += pace * pool.jobs[k].estimate;
  for (const auto& [process, running] : pool.running) {
    const double rest = std::max(0.0, pace * running.job->estimate - seconds_since(running.since));
    left += rest;
    longest = std::max(longest, rest);
  }
  return std::max(left / pool.options.at_once, longest);
}

void show(const Pool& pool, PoolProgress progress = {}) {
  if (!pool.options.show) return;
  progress.all = pool.options.all;
  progress.done = pool.options.all - pool.jobs.size() + pool.done;
  progress.running = pool.running.size();
  progress.seconds = seconds_since(pool.begin);
  progress.seconds_left = seconds_left(pool);
  pool.options.show(progress);
}

void end(Pool& pool, const Running& ended, int exit_code) {
  PoolProgress progress;
  progress.ended = ended.job;
  progress.exit_code = exit_code;
  progress.seconds_of_job = seconds_since(ended.since);
  if (exit_code == 0) {
    ++pool.done;
    pool.estimate_of_done += ended.job->estimate;
    pool.seconds_of_done += progress.seconds_of_job;
  } else {
    pool.failed.push_back({ended.job->log, exit_code});
  }
  show(pool, progress);
}

/// Takes the jobs out of the pool that have ended.
void collect(Pool& pool) {
  for (auto child = pool.running.begin(); child != pool.running.end();) {
    int status = 0;
    if (waitpid(child->first, &status, WNOHANG) != child->first) {
      ++child;
      continue;
    }
    const Running ended = child->second;
    child = pool.running.erase(child);
    end(pool, ended, WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status));
  }
}

}  // namespace

std::vector<FailedJob> run_jobs(const std::vector<Job>& jobs, const PoolOptions& options) {
  for (const Job& job : jobs) {
    prepare_folder_of(job.log);
    output_target(job.log);  // a FIFO would wait for somebody to read it
  }
  const HeldSignals signals;
  Pool pool{jobs, options};
  bool stopped = false, given_up = false;
  while (!pool.running.empty() || (!stopped && !given_up && pool.next < jobs.size())) {
    while (!stopped && !given_up && pool.next < jobs.size() &&
           pool.running.size() < static_cast<std::size_t>(options.at_once)) {
      const Job& job = jobs[pool.next++];
      pool.running.emplace(start(job, signals.before()), Running{&job, Clock::now()});
    }
    const int signal = signals.wait();
    const bool asked = signal == SIGINT || signal == SIGTERM || signal == SIGHUP;
    const bool gives_up = !asked && !given_up && options.give_up && options.give_up();
    stopped = stopped || asked;
    given_up = given_up || gives_up;
    if (asked || gives_up)
      for (const auto& [process, running] : pool.running) kill(process, SIGTERM);
    collect(pool);
    show(pool);
  }
  if (stopped)
    throw Error(ExitCode::stopped,
                fmt::format("the {} was stopped; repeat the command to continue", options.work));
  return pool.failed;
}

void refuse(const std::vector<FailedJob>& failed, const std::string& consequence) {
  std::string text = fmt::format("{}{} ended with an error, {}; see", failed.size(),
                                 failed.size() == 1 ? " run" : " runs", consequence);
  for (const FailedJob& job : failed) text += fmt::format("\n  {} (exit code {})", job.log, job.exit_code);
  const int code = failed.front().exit_code;
  throw Error(code > 128 ? ExitCode::internal : static_cast<ExitCode>(code), text);
}

bool is_complete(const Member& member, const std::string& work) {
  const RunPresence presence = run_presence(member.path);
  if (presence == RunPresence::none) return false;
  // Values are compared, not texts: a key that an earlier version did not have is at its default in it.
  if (stored_scenario(RunFile::open(member.path).header(), member.path) != member.scenario)
    throw Error(ExitCode::bad_data,
                fmt::format("{} is a run of another scenario than this {}'s; expected the scenario, the "
                            "settings and the version that the {} began with; give another folder",
                            member.path, work, work));
  return presence == RunPresence::packed;
}

Job job_of(const Member& member, std::vector<std::string> arguments) {
  return {member.name, std::move(arguments), file_beside(member.path, ".log"),
          estimate(member.scenario).seconds};
}

void add_settings(std::vector<std::string>& arguments, const std::vector<std::string>& settings) {
  for (const std::string& setting : settings) arguments.insert(arguments.end(), {"--set", setting});
}

std::string path_word(const std::string& path) { return path.starts_with('-') ? "./" + path : path; }

}  // namespace talus
