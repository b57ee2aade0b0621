#pragma once
/// Errors by cause. Each cause has an exit code (docs/errors.md).

#include <stdexcept>
#include <string>

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
