#pragma once
/// Programs started by this one.

#include <sys/types.h>

#include <functional>
#include <string>
#include <vector>

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

/// Starts words[0], found by PATH, with the other words as its arguments, in a folder. The program is killed
/// (SIGKILL) when this process ends for any reason. Returns its process id, or -1 with the reason in errno if
/// it cannot be started.
pid_t start_program(const std::vector<std::string>& words, const ProgramStreams& streams,
                    const std::string& folder = ".",
                    ProgramEnvironment environment = ProgramEnvironment::clean);

/// Starts another process of this program with these arguments, even if its file has been replaced meanwhile.
/// The process receives SIGTERM when this one ends, so that it can commit its results. It is in a separate
/// process group, so that Ctrl-C reaches it through this process only. Returns as start_program.
pid_t start_this_program(const std::vector<std::string>& arguments, const ProgramStreams& streams);

/// Waits until a program has ended and returns its status (waitpid). `meanwhile` is called ten times a
/// second, unless it is empty; if it throws, the program is killed.
int wait_for_program(pid_t program, const std::function<void()>& meanwhile);

}  // namespace talus
