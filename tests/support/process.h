#pragma once
/// Runs the program as a user does.

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "support/temporary_folder.h"

namespace talus::test {

using Words = std::vector<std::string>;

inline Words operator+(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

struct Outcome {
  int exit_code = -1;  ///< -1 if a signal ended it
  std::string out;
  std::string err;
};

/// Runs `talus` with arguments in a folder, with additional variables ("NAME=value") in its environment, and
/// waits for it.
Outcome run_talus(const Words& arguments, const std::filesystem::path& folder, const Words& environment = {});

/// Starts it without output; the caller sends signals and collects it with wait_for.
pid_t start_talus(const Words& arguments, const std::filesystem::path& folder);
/// Returns the stderr output of the last program started in a folder.
std::string errors_in(const std::filesystem::path& folder);
int wait_for(pid_t process);
/// Returns whether wait_for would return at once.
bool has_ended(pid_t process);
/// Waits until the process handles the signal, for at most half a minute.
bool wait_until_caught(pid_t process, int signal);
using Clock = std::chrono::steady_clock;

inline double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Waits until `holds()`, for at most half a minute; returns whether it does.
template <typename Condition>
bool wait_until(const Condition& holds) {
  for (int wait = 0; wait < 30'000; ++wait, std::this_thread::sleep_for(std::chrono::milliseconds(1)))
    if (holds()) return true;
  return false;
}
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

/// Returns the names in a folder; none if it does not exist.
inline std::set<std::string> names_in(const std::filesystem::path& folder) {
  std::set<std::string> names;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(folder, none))
    names.insert(entry.path().filename().string());
  return names;
}

/// Writes a file in the folder and returns its name.
std::string write_file(const TemporaryFolder& folder, const std::string& name, const std::string& text);

/// Returns the lines of a page of the documentation that call `talus` with one of these commands, split into
/// words, without comments.
std::vector<Words> talus_commands(const std::string& page, const Words& names);

/// Returns the value of a key in flat JSON text, which suffices for the output of `talus info --json`.
std::string json_value(const std::string& json, const std::string& key);

}  // namespace talus::test
