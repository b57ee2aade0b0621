#pragma once
/// Programs beside this one, and what they say.

#include <string>
#include <vector>

#include "base/child_program.h"

namespace talus::app {

/// How a program ended, and what it said, without blank lines at the ends.
struct ProgramOutput {
  int status = 0;  ///< as of waitpid; 0: well
  std::string out, err;
};

/// Runs words[0], as PATH finds it, in a folder and waits for it. Throws Error(unavailable), with `advice` as
/// the message where there is no such program; and Error(stopped) where a signal asks for it, which ends the
/// program, unless `until_its_end`: then it is waited for all the same.
ProgramOutput output_of(const std::vector<std::string>& words, const std::string& folder,
                        ProgramEnvironment environment, const std::string& advice,
                        bool until_its_end = false);

}  // namespace talus::app
