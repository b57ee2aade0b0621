#include "app/other_programs.h"

#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fmt/core.h>

#include "app/program_end.h"
#include "base/child_program.h"
#include "base/errors.h"
#include "base/output_file.h"

namespace talus::app {
namespace {

/// No useful output is longer.
constexpr std::size_t longest = std::size_t{1} << 24;

/// Returns the text without blank lines at the ends.
std::string stripped(const std::string& all) {
  const auto first = all.find_first_not_of(" \n");
  return first == std::string::npos ? "" : all.substr(first, all.find_last_not_of(" \n") + 1 - first);
}

/// Reads the output of a program until it ends, or, unless `until_its_end`, a signal. Returns its status.
int wait_reading(pid_t program, const std::vector<ProgramText*>& texts, bool until_its_end) {
  for (ProgramText* text : texts) text->close_end();
  const auto read = [&] {
    for (ProgramText* text : texts) text->read();
    if (!until_its_end) stop_if_asked();
  };
  const int status = wait_for_program(program, read);
  read();  // also ends here after Ctrl-C, which is not a failure of the program
  return status;
}

}  // namespace

ProgramOutput output_of(const std::vector<std::string>& words, const std::string& folder,
                        ProgramEnvironment environment, const std::string& advice, bool until_its_end) {
  ProgramText out(longest), err(longest);
  const pid_t program = start_program(words, {.out = out.end(), .err = err.end()}, folder, environment);
  if (program < 0 && errno == ENOENT) throw Error(ExitCode::unavailable, advice);
  if (program < 0) throw system_error(ExitCode::unavailable, "start", words[0], errno);
  const int status = wait_reading(program, {&out, &err}, until_its_end);
  return {status, stripped(out.text()), stripped(err.text())};
}

namespace {

/// No useful output is longer.
constexpr std::size_t longest_of_module = std::size_t{1} << 28;

/// Returns the script that starts the modules of the package that belongs to this program: in a build, or
/// where it was installed (python/CMakeLists.txt).
std::string start_script() {
  const std::filesystem::path program = resolved_path("/proc/self/exe"), folder = program.parent_path(),
                              prefix = folder.parent_path();
  for (const std::filesystem::path& packages :
       {folder / "python", prefix / TALUS_PYTHON_FOLDER,
        prefix / "lib" / TALUS_PYTHON_VERSION / "dist-packages", prefix / "lib/python3/dist-packages"})
    if (std::string script = packages / "talus" / "start.py"; is_there(script)) return script;
  throw Error(ExitCode::unavailable,
              "this command needs the Python package talus, which was not installed with {}: apt-get install "
              "python3-dev pybind11-dev, and build and install Talus again",
              program.string());
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
  ProgramText out(longest_of_module);
  std::fflush(stdout);
  const pid_t program = start_program(words_of(name, arguments), {.out = out.end(), .err = STDERR_FILENO},
                                      ".", ProgramEnvironment::whole);
  if (program < 0) refuse_start(errno);
  const int status = wait_reading(program, {&out}, false);
  if (status != 0) throw CLI::RuntimeError(WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status));
  return out.text();
}

}  // namespace talus::app
