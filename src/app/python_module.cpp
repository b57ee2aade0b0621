#include "app/python_module.h"

#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fmt/core.h>

#include "app/stop_signals.h"
#include "base/child_program.h"
#include "base/errors.h"
#include "base/paths.h"

namespace talus::app {
namespace {

/// No useful output is longer.
constexpr std::size_t longest = std::size_t{1} << 28;

/// Returns the script that starts the modules of the package that belongs to this program: in a build, or
/// where it was installed (python/CMakeLists.txt).
std::string start_script() {
  const std::filesystem::path program = resolved_path("/proc/self/exe"), folder = program.parent_path(),
                              prefix = folder.parent_path();
  for (const std::filesystem::path& packages :
       {folder / "python", prefix / TALUS_PYTHON_FOLDER,
        prefix / "lib" / TALUS_PYTHON_VERSION / "dist-packages", prefix / "lib/python3/dist-packages"})
    if (std::string script = packages / "talus" / "start.py"; is_there(script)) return script;
  throw Error(
      ExitCode::unavailable,
      fmt::format(
          "this command needs the Python package talus, which was not installed with {}: apt-get install "
          "python3-dev pybind11-dev, and build and install Talus again",
          program.string()));
}

/// Returns the command line of a module. The interpreter is that of the extension, if it is there.
std::vector<std::string> words_of(const std::string& name, const std::vector<std::string>& arguments) {
  std::vector<std::string> words = {
      is_there(TALUS_PYTHON) ? TALUS_PYTHON : "python3", "-P", "-X", "utf8", start_script(), name};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return words;
}

[[noreturn]] void refuse_start(int reason) {
  if (reason == ENOENT)
    throw Error(ExitCode::unavailable,
                "this command needs Python, which is not installed: apt-get install python3 python3-h5py "
                "python3-matplotlib python3-xxhash");
  throw system_error(ExitCode::unavailable, "start", "python3", reason);
}

}  // namespace

void become_python_module(const std::string& name, const std::vector<std::string>& arguments) {
  std::vector<std::string> words = words_of(name, arguments);
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  std::fflush(stdout);
  // Signals wait until the module handles them (start.py).
  sigset_t stops;
  ::sigemptyset(&stops);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) ::sigaddset(&stops, signal);
  ::sigprocmask(SIG_BLOCK, &stops, nullptr);
  stop_if_asked();
  ::execvp(pointers[0], pointers.data());
  refuse_start(errno);
}

std::string output_of_python_module(const std::string& name, const std::vector<std::string>& arguments) {
  ProgramText out(longest);
  std::fflush(stdout);
  const pid_t program = start_program(words_of(name, arguments), {.out = out.end(), .err = STDERR_FILENO},
                                      ".", ProgramEnvironment::whole);
  if (program < 0) refuse_start(errno);
  out.close_end();
  const auto read = [&out] {
    out.read();
    stop_if_asked();
  };
  const int status = wait_for_program(program, read);
  read();  // also ends here after Ctrl-C, which is not a failure of the module
  if (status != 0) throw CLI::RuntimeError(WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status));
  return out.text();
}

}  // namespace talus::app
