#pragma once
/// Base holds what every room needs and no physics: errors with an exit code, texts for people (text.h),
/// files that appear complete or not at all (output_file.h), threads with the same results for any number of
/// them (thread_team.h), and hashes (hash.h).
///
/// Errors by cause. Each cause has an exit code (docs/errors.md).

#if __has_include(<fmt/core.h>)
#include <fmt/core.h>
#endif
#include <stdexcept>
#include <string>
#include <utility>

namespace talus {

/// Exit codes of every Talus command.
enum class ExitCode : int {
  done = 0,
  usage = 64,          ///< unknown option, missing argument
  bad_data = 65,       ///< a scenario, run file or checkpoint that cannot be accepted
  missing_input = 66,  ///< an input file that does not exist or cannot be read
  unavailable = 69,    ///< no rendering context, display, shader, ffmpeg, Python or Slurm
  internal = 70,       ///< a defect of Talus, or a state that is not finite
  out_of_memory = 71,
  cannot_create = 73,  ///< output exists already, is locked, or its folder cannot be written
  io_error = 74,       ///< a read or write failed
  stopped = 75,        ///< stopped on request, which is not an error; the run can be resumed
};

/// An error with a message for the user. The message says what was found and where, what was expected, and
/// what to do, without the prefix "error:" and without a trailing newline.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
#if defined FMT_VERSION && FMT_VERSION >= 80000  // programs that use the library may lack it
  /// Formats the message.
  template <typename First, typename... Rest>
  Error(ExitCode code, fmt::format_string<First, Rest...> form, First&& first, Rest&&... rest)
      : Error(code, fmt::format(form, std::forward<First>(first), std::forward<Rest>(rest)...)) {}
#endif
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

/// Errors at positions in a file. Each line of the message is complete, `file:line:column: error: ...`, and
/// is printed unchanged.
class LocatedError : public Error {
 public:
  using Error::Error;
};

/// Returns an Error with the given code and the message `path: cannot action: reason of errno`.
Error system_error(ExitCode code, const std::string& action, const std::string& path, int errno_value);

/// Returns the Error for a file or folder that cannot be created, with the code io_error if the disk is full
/// or fails, otherwise cannot_create.
Error creation_error(const std::string& action, const std::string& path, int errno_value);

}  // namespace talus
