#pragma once
/// How the packed file of a run begins.

#include <string>

namespace talus {

/// Whether the regular file at `path` begins as the packed file of a run, sound or damaged. False where it
/// cannot be read.
bool begins_as_run(const std::string& path);

}  // namespace talus
