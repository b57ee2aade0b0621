#pragma once
/// Programs started by this one.

#include <signal.h>
#include <sys/types.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/output_file.h"

namespace talus {

/// Descriptors of the standard streams of a program; a negative one is /dev/null.
struct ProgramStreams {
  int in = -1, out = -1, err = -1;
};

/// Environment of a program.
enum class ProgramEnvironment {
  clean,  ///< paths of programs, libraries and temporary files only, so that output depends on no locale or
          ///< home
  whole,  ///< entire environment, for a program that acts for the user
};

/// Collects what a program writes to a stream. What exceeds a limit is read and dropped, so that a program
/// that writes without end takes neither memory nor disk.
class ProgramText {
 public:
  /// Throws Error(io_error).
  explicit ProgramText(std::size_t limit);
  /// Returns the descriptor for the stream of the program.
  int end() const { return to_.get(); }
  /// Closes that descriptor in this process; call when the program has been started.
  void close_end() { to_.close(); }
  /// Reads the existing bytes, without waiting.
  void read();
  const std::string& text() const { return text_; }

 private:
  std::size_t limit_;
  Descriptor from_, to_;
  std::string text_;
};

/// Starts words[0], found by PATH, with the other words as its arguments, in a folder. The program and those
/// that it starts are a process group of their own, which is killed (SIGKILL) when this process ends for any
/// reason. Returns its process id, or -1 with the reason in errno if it cannot be started.
pid_t start_program(const std::vector<std::string>& words, const ProgramStreams& streams,
                    const std::string& folder = ".",
                    ProgramEnvironment environment = ProgramEnvironment::clean);

/// Starts another process of this program with these arguments, even if its file has been replaced meanwhile.
/// The process receives SIGTERM when this one ends, so that it can commit its results. It is in a separate
/// process group, so that Ctrl-C reaches it through this process only. Returns as start_program.
pid_t start_this_program(const std::vector<std::string>& arguments, const ProgramStreams& streams);

/// How a process of this program that passes a signal on wants its child to stop.
enum class StopRequest {
  once = 1,     ///< request of a first signal, which the child may have received itself
  at_once = 2,  ///< without committing anything more
};

/// Passes a request to stop on to a process that start_this_program has started, as a SIGTERM that names the
/// request: a batch system sends its signal to a whole tree of processes, and one that is also passed on must
/// not count as the second.
void pass_on_stop(pid_t process, StopRequest request);

/// Returns the request in a signal that was passed on; nothing for any other signal.
std::optional<StopRequest> passed_on(const siginfo_t& signal);

/// Time after the first signal during which others are considered repetitions of it, in s.
inline constexpr double repeats_end = 1.0;

/// Kills a program with those that it has started.
void kill_program(pid_t program);

/// Waits until a program has ended and returns its status (waitpid). `meanwhile` is called ten times a
/// second, unless it is empty; if it throws, the program is killed.
int wait_for_program(pid_t program, const std::function<void()>& meanwhile);

}  // namespace talus
