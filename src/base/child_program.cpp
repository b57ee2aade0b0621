#include "base/child_program.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fmt/core.h>

#include "base/errors.h"

namespace talus {
namespace {

constexpr const char* kept_variables[] = {"PATH", "LD_LIBRARY_PATH", "TMPDIR"};

std::vector<std::string> clean_environment() {
  std::vector<std::string> variables = {"LC_ALL=C.UTF-8"};
  for (const char* name : kept_variables)
    if (const char* value = std::getenv(name)) variables.push_back(fmt::format("{}={}", name, value));
  return variables;
}

std::vector<std::string> whole_environment() {
  std::vector<std::string> variables;
  for (char** variable = environ; *variable != nullptr; ++variable) variables.emplace_back(*variable);
  return variables;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> result;
  result.reserve(texts.size() + 1);
  for (std::string& text : texts) result.push_back(text.data());
  result.push_back(nullptr);
  return result;
}

/// Everything that the child needs, prepared before the fork because it must not allocate.
struct Start {
  const char* file;  ///< name that PATH finds
  std::vector<char*> words, variables;
  ProgramStreams streams;
  const char* folder;
  int end_signal;  ///< signal that it receives when its parent ends
  bool own_group;
  bool supervised;  ///< whether what it starts ends with this process as well
  pid_t parent;
};

/// Runs between fork and exec, with calls that are safe there. Returns only if it fails.
void become(const Start& start) {
  prctl(PR_SET_PDEATHSIG, start.end_signal);
  if (::getppid() != start.parent) _exit(1);  // the parent has ended already
  if (start.own_group) ::setpgid(0, 0);
  // A program that exceeds the file size limit must fail, and so must one that writes to a process that has
  // ended.
  for (const int signal : {SIGXFSZ, SIGPIPE}) std::signal(signal, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  const int nowhere = ::open("/dev/null", O_RDWR | O_CLOEXEC);
  const auto& [in, out, err] = start.streams;
  for (const auto& [stream, from] : {std::pair{STDIN_FILENO, in}, {STDOUT_FILENO, out}, {STDERR_FILENO, err}})
    ::dup2(from < 0 ? nowhere : from, stream);
  if (::chdir(start.folder) == 0) ::execvpe(start.file, start.words.data(), start.variables.data());
}

/// Writes the reason why the program cannot be started to the pipe `to`, and ends.
[[noreturn]] void report_failure(int to) {
  const int reason = errno;
  [[maybe_unused]] const ssize_t written = ::write(to, &reason, sizeof reason);
  _exit(1);
}

void kill_own_group(int) { ::kill(0, SIGKILL); }

/// Ends as the program did, without a core.
[[noreturn]] void end_as(int status) {
  if (!WIFSIGNALED(status)) _exit(WEXITSTATUS(status));
  const rlimit no_core = {0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  std::signal(WTERMSIG(status), SIG_DFL);
  ::raise(WTERMSIG(status));
  _exit(128 + WTERMSIG(status));
}

/// Is the process between this one and the program: it ends with the program, and kills the group of both
/// when this process ends, for a program started by the program does not notice that. Makes only calls that
/// are safe after a fork.
[[noreturn]] void supervise(Start start, int to) {
  ::setpgid(0, 0);
  struct sigaction action = {};
  action.sa_handler = kill_own_group;
  ::sigaction(SIGTERM, &action, nullptr);
  for (const int signal : {SIGINT, SIGHUP, SIGALRM, SIGUSR1, SIGCHLD}) std::signal(signal, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != start.parent) _exit(1);  // the parent has ended already
  start.parent = ::getpid();
  const pid_t program = ::_Fork();
  if (program == 0) {
    std::signal(SIGTERM, SIG_DFL);
    become(start);
  }
  if (program <= 0) report_failure(to);
  ::close_range(0, ~0U, 0);  // locks and pipes of this process
  int status = 0;
  while (::waitpid(program, &status, 0) < 0 && errno == EINTR) continue;
  end_as(status);
}

/// Starts the program; returns its process id once it runs, or -1.
pid_t run(const Start& start) {
  int ends[2] = {-1, -1};
  if (::pipe2(ends, O_CLOEXEC) != 0) return -1;
  const Descriptor from(ends[0]);
  Descriptor to(ends[1]);
  const pid_t child = ::fork();
  if (child == 0) {
    if (start.supervised) supervise(start, to.get());
    become(start);
    report_failure(to.get());
  }
  if (child < 0) return -1;
  to.close();
  int reason = 0;
  ssize_t count = 0;
  while ((count = ::read(from.get(), &reason, sizeof reason)) < 0 && errno == EINTR) continue;
  if (count == 0) return child;  // the pipe was closed by exec
  wait_for_program(child, {});
  errno = reason;
  return -1;
}

}  // namespace

pid_t start_program(const std::vector<std::string>& words, const ProgramStreams& streams,
                    const std::string& folder, ProgramEnvironment environment) {
  std::vector<std::string> arguments = words, variables = environment == ProgramEnvironment::whole
                                                              ? whole_environment()
                                                              : clean_environment();
  return run({words[0].c_str(), pointers(arguments), pointers(variables), streams, folder.c_str(), SIGKILL,
              false, true, ::getpid()});
}

pid_t start_this_program(const std::vector<std::string>& arguments, const ProgramStreams& streams) {
  std::vector<std::string> words = {"talus"}, variables = whole_environment();
  words.insert(words.end(), arguments.begin(), arguments.end());
  return run({"/proc/self/exe", pointers(words), pointers(variables), streams, ".", SIGTERM, true, false,
              ::getpid()});
}

void pass_on_stop(pid_t process, StopRequest request) {
  sigval value{};
  value.sival_int = static_cast<int>(request);
  ::sigqueue(process, SIGTERM, value);
}

std::optional<StopRequest> passed_on(const siginfo_t& signal) {
  if (signal.si_code != SI_QUEUE) return std::nullopt;
  const auto request = static_cast<StopRequest>(signal.si_value.sival_int);
  return request == StopRequest::once || request == StopRequest::at_once ? std::optional(request)
                                                                         : std::nullopt;
}

ProgramText::ProgramText(std::size_t limit) : limit_(limit), from_(-1), to_(-1) {
  int ends[2] = {-1, -1};
  if (::pipe2(ends, O_CLOEXEC) != 0) throw system_error(ExitCode::io_error, "make", "a pipe", errno);
  from_ = Descriptor(ends[0]);
  to_ = Descriptor(ends[1]);
  ::fcntl(from_.get(), F_SETFL, O_NONBLOCK);
  ::fcntl(from_.get(), F_SETPIPE_SZ, 1 << 20);  // so that a program seldom waits; it can without
}

void ProgramText::read() {
  char part[4096];
  ssize_t count = 0;
  std::size_t most = std::size_t{1} << 24;  // returns also while a program writes without end
  while (most > 0 && (count = ::read(from_.get(), part, sizeof part)) != 0) {
    if (count < 0 && errno != EINTR) return;
    if (count < 0) continue;
    text_.append(part, std::min(static_cast<std::size_t>(count), limit_ - text_.size()));
    most -= std::min(most, static_cast<std::size_t>(count));
  }
}

void kill_program(pid_t program) {
  if (::kill(-program, SIGKILL) != 0) ::kill(program, SIGKILL);
}

int wait_for_program(pid_t program, const std::function<void()>& meanwhile) {
  int status = 0;
  const auto collect = [&] {
    while (::waitpid(program, &status, 0) < 0 && errno == EINTR) continue;
  };
  const Descriptor handle(meanwhile ? static_cast<int>(::syscall(SYS_pidfd_open, program, 0)) : -1);
  pollfd ended = {handle.get(), POLLIN, 0};
  constexpr int milliseconds = 100;
  try {
    while (handle.get() >= 0 && ::poll(&ended, 1, milliseconds) <= 0) meanwhile();
  } catch (...) {
    kill_program(program);
    collect();
    throw;
  }
  collect();
  return status;
}

}  // namespace talus
