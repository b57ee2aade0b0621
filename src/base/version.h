#pragma once
/// The version of the program and how it was built. The values are in a source of their own, written by
/// CMake, so that a commit recompiles nothing else.

#include <string>

namespace talus {

extern const char* const version;  ///< such as "0.1.0"
extern const char* const
    git_hash;  ///< of the commit, with "-dirty" if the tree differed; "unknown" without git
extern const char* const compiler;     ///< name and version
extern const char* const build_flags;  ///< that affect arithmetic and optimisation

/// "0.1.0 (1234567890ab)".
std::string version_and_commit();
/// "talus 0.1.0 (1234567890ab)".
std::string version_text();

}  // namespace talus
