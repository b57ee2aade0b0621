#pragma once
/// Runs the program as a user does.

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "support/temporary_folder.h"

namespace talus::test {

struct Outcome {
  int exit_code = -1;  ///< -1 if a signal ended it
  std::string out;
  std::string err;
};

/// Runs `talus` with arguments in a folder, with additional variables ("NAME=value") in its environment, and
/// waits for it.
Outcome run_talus(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                  const std::vector<std::string>& environment = {});

/// Starts it without output; the caller sends signals and collects it with wait_for.
pid_t start_talus(const std::vector<std::string>& arguments, const std::filesystem::path& folder);
/// Returns the stderr output of the last program started in a folder.
std::string errors_in(const std::filesystem::path& folder);
int wait_for(pid_t process);
/// Returns whether wait_for would return at once.
bool has_ended(pid_t process);
/// Waits until the process handles the signal, for at most half a minute.
bool wait_until_caught(pid_t process, int signal);
/// Sleeps for this time before attempt 0 to stop a program, and a quarter longer before each further attempt,
/// so that the program finishes in few attempts on a slow machine.
void pause_before(int attempt, double milliseconds);
/// Starts a program repeatedly and sends it a signal a little later each time, until it finishes. Returns the
/// exit code of each attempt: the last is 0, unless 40 attempts are not enough. If a busy machine delays the
/// first signal until the program is done, its result is removed, and everything is repeated.
std::vector<int> stop_until_done(const std::function<pid_t()>& start, int signal, double milliseconds,
                                 const std::filesystem::path& result);

/// Whether the program finds its Python package, and can use the extension: not in a build with a sanitizer.
bool has_python_package();

/// Returns the content of a file; empty if it does not exist.
std::string text_of(const std::filesystem::path& path);

/// Writes a file in the folder and returns its name.
std::string write_file(const TemporaryFolder& folder, const std::string& name, const std::string& text);

/// Returns the value of a key in flat JSON text, which suffices for the output of `talus info --json`.
std::string json_value(const std::string& json, const std::string& key);

}  // namespace talus::test
