#pragma once
/// Other programs: child processes and their output, and modules of the Python package.

#include <string>
#include <vector>

#include "base/child_program.h"

namespace talus::app {

/// Exit status and output of a program, without blank lines at the ends.
struct ProgramOutput {
  int status = 0;  ///< wait status of waitpid; 0: success
  std::string out, err;
};

/// Runs words[0], found through PATH, in a folder and waits for it. Throws Error(unavailable) with the
/// message `advice` if there is no such program. On a signal it ends the program and throws Error(stopped),
/// unless `until_its_end` is set, in which case it still waits for the program.
ProgramOutput output_of(const std::vector<std::string>& words, const std::string& folder,
                        ProgramEnvironment environment, const std::string& advice,
                        bool until_its_end = false);

/// Replaces this process by the module talus.NAME of the package of this program, which parses the arguments:
/// streams, signals and the exit code are those of the module. Call last. Throws
/// Error(unavailable), which says what to install, if there is no Python or no package; the module itself
/// says so, with the same code, if a package that it needs is missing (python/talus/start.py).
[[noreturn]] void become_python_module(const std::string& name, const std::vector<std::string>& arguments);

/// Runs such a module as a child process and returns its standard output; its messages go to stderr at once.
/// On a signal the module is ended, with Error(stopped). Throws CLI::RuntimeError with the exit code of a
/// module that fails, which has printed its message; and as become_python_module does.
std::string output_of_python_module(const std::string& name, const std::vector<std::string>& arguments);

}  // namespace talus::app
