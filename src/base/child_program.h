#pragma once
/// Other programs that this one starts.

#include <sys/types.h>

#include <functional>
#include <string>
#include <vector>

namespace talus {

/// Descriptors of its standard streams; one that is negative is /dev/null.
struct ProgramStreams {
  int in = -1, out = -1, err = -1;
};

/// What a program sees of the environment.
enum class ProgramEnvironment {
  clean,  ///< where programs, libraries and temporary files are: what it writes depends on no locale or home
  whole,  ///< all of it: the program acts for the user, with the settings of the user
};

/// Starts words[0], as PATH finds it, with the other words as its arguments, in a folder. It ends when this
/// process ends, however that is (SIGKILL). Returns its process, or -1 with the reason in errno where it
/// cannot be started.
pid_t start_program(const std::vector<std::string>& words, const ProgramStreams& streams,
                    const std::string& folder = ".",
                    ProgramEnvironment environment = ProgramEnvironment::clean);

/// Starts another process of this very program, even where its file has been replaced since, with these
/// arguments. It is asked to end (SIGTERM) when this process ends, so that it can commit what it computes,
/// and is in a group of its own, so that Ctrl-C reaches it through this process alone. Returns as
/// start_program.
pid_t start_this_program(const std::vector<std::string>& arguments, const ProgramStreams& streams);

/// Waits until it has ended and returns its status (waitpid). `meanwhile` is called ten times a second, or
/// may be empty; where it throws, the program is ended.
int wait_for_program(pid_t program, const std::function<void()>& meanwhile);

}  // namespace talus
