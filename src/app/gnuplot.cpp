#include "app/gnuplot.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <memory>

#include "core/errors.h"

extern char** environ;

namespace talus {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

/// Runs `gnuplot ARGUMENT` in a folder with all that it says in `messages`, and returns its wait status.
int run(const std::string& folder, std::string argument, std::FILE* messages) {
  std::string program = "gnuplot";
  std::array<char*, 3> arguments = {program.data(), argument.data(), nullptr};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, fileno(messages), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, fileno(messages), STDERR_FILENO);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  pid_t child = -1;
  const int error = posix_spawnp(&child, program.c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error == ENOENT)
    throw Error(ExitCode::unavailable,
                "gnuplot is not installed, and figures are drawn by it; apt-get install gnuplot-nox");
  if (error != 0) throw system_error(ExitCode::unavailable, "start", "gnuplot", error);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

File open_messages() {
  File file(std::tmpfile());
  if (!file) throw system_error(ExitCode::io_error, "open", "a temporary file", errno);
  return file;
}

/// What was written to the file, without blank lines at its ends.
std::string text_of(std::FILE* file) {
  std::rewind(file);
  std::array<char, 2048> text{};
  const std::string all(text.data(), std::fread(text.data(), 1, text.size(), file));
  const auto first = all.find_first_not_of(" \n");
  return first == std::string::npos ? "" : all.substr(first, all.find_last_not_of(" \n") + 1 - first);
}

}  // namespace

void require_gnuplot() { run(".", "--version", open_messages().get()); }

void run_gnuplot(const std::string& folder, const std::string& script) {
  const File messages = open_messages();
  if (run(folder, script, messages.get()) == 0) return;
  const std::string said = text_of(messages.get());
  throw Error(ExitCode::io_error,
              script + ": gnuplot gave up" + (said.empty() ? std::string() : ": " + said));
}

}  // namespace talus
