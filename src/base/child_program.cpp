#include "base/child_program.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fmt/core.h>

#include "base/descriptor.h"

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
  int end_signal;  ///< signal that it receives when this process ends
  bool own_group;
  pid_t parent;
};

void connect_stream(int stream, int from, int nowhere) { ::dup2(from < 0 ? nowhere : from, stream); }

/// Runs between fork and exec, with calls that are safe there. Returns only if it fails.
void become(const Start& start) {
  prctl(PR_SET_PDEATHSIG, start.end_signal);
  if (::getppid() != start.parent) _exit(1);  // the parent has ended already
  if (start.own_group) ::setpgid(0, 0);
  std::signal(SIGXFSZ, SIG_DFL);  // a program that exceeds the file size limit must fail
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  const int nowhere = ::open("/dev/null", O_RDWR | O_CLOEXEC);
  connect_stream(STDIN_FILENO, start.streams.in, nowhere);
  connect_stream(STDOUT_FILENO, start.streams.out, nowhere);
  connect_stream(STDERR_FILENO, start.streams.err, nowhere);
  if (::chdir(start.folder) == 0) ::execvpe(start.file, start.words.data(), start.variables.data());
}

/// Starts the program; returns its process id once it runs, or -1.
pid_t run(const Start& start) {
  int ends[2] = {-1, -1};
  if (::pipe2(ends, O_CLOEXEC) != 0) return -1;
  const Descriptor from(ends[0]);
  Descriptor to(ends[1]);
  const pid_t child = ::fork();
  if (child == 0) {
    become(start);
    const int reason = errno;
    [[maybe_unused]] const ssize_t written = ::write(to.get(), &reason, sizeof reason);
    _exit(1);
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
              false, ::getpid()});
}

pid_t start_this_program(const std::vector<std::string>& arguments, const ProgramStreams& streams) {
  std::vector<std::string> words = {"talus"}, variables = whole_environment();
  words.insert(words.end(), arguments.begin(), arguments.end());
  return run(
      {"/proc/self/exe", pointers(words), pointers(variables), streams, ".", SIGTERM, true, ::getpid()});
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
    ::kill(program, SIGKILL);
    collect();
    throw;
  }
  collect();
  return status;
}

}  // namespace talus
