#pragma once
/// Child processes and their output.

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

}  // namespace talus::app
