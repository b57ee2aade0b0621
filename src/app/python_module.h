#pragma once
/// Modules of the Python package that carry out commands of this program.

#include <string>
#include <vector>

namespace talus::app {

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
