#pragma once
/// Running the program as a user does.

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "support/temporary_folder.h"

namespace talus::test {

struct Outcome {
  int exit_code = -1;  ///< -1 where a signal ended it
  std::string out;
  std::string err;
};

/// Runs `talus` with arguments in a folder, with more variables ("NAME=value") in its environment, and waits
/// for it.
Outcome run_talus(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                  const std::vector<std::string>& environment = {});

/// Starts it with its output thrown away; the caller sends signals and collects it with wait_for.
pid_t start_talus(const std::vector<std::string>& arguments, const std::filesystem::path& folder);
/// What the last one that was started in a folder has said on stderr.
std::string errors_in(const std::filesystem::path& folder);
int wait_for(pid_t process);
/// Whether wait_for would return at once.
bool has_ended(pid_t process);
/// Waits until it has a handler for the signal, for half a minute at most.
bool wait_until_it_catches(pid_t process, int signal);
/// Sleeps for that long before attempt 0 to stop something, and a quarter longer before each one more: it
/// comes to its end in few attempts, however slow the machine.
void pause_before(int attempt, double milliseconds);
/// Starts a program again and again, and sends it a signal a little later each time, until it comes to its
/// end. Returns the exit code of each time: the last is 0, unless 40 times are not enough. On a machine so
/// busy that the program is done before the first signal, its result is removed, and all begins anew.
std::vector<int> stop_until_done(const std::function<pid_t()>& start, int signal, double milliseconds,
                                 const std::filesystem::path& result);

/// All of a file; empty where there is none.
std::string text_of(const std::filesystem::path& path);

/// Writes a file in the folder and returns its name.
std::string write_file(const TemporaryFolder& folder, const std::string& name, const std::string& text);

/// The value of a key in flat JSON text: enough for the output of `talus info --json`.
std::string json_value(const std::string& json, const std::string& key);

}  // namespace talus::test
