#pragma once
/// The version of the program and how it was built. CMake writes the values into a separate source, so that a
/// commit recompiles nothing else.

#include <string>

namespace talus {

extern const char* const version;  ///< such as "0.1.0"
extern const char* const
    git_hash;  ///< hash of the commit, with "-dirty" if the tree differed; "unknown" without git
extern const char* const compiler;     ///< name and version
extern const char* const build_flags;  ///< flags that affect arithmetic and optimisation

/// Returns a text such as "0.1.0 (1234567890ab)".
std::string version_and_commit();
/// Returns a text such as "talus 0.1.0 (1234567890ab)".
std::string version_text();

// The sanitizer with which the program is built. It changes memory limits.

#if defined(__SANITIZE_ADDRESS__)
inline constexpr bool sanitizes_addresses = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
inline constexpr bool sanitizes_addresses = true;
#else
inline constexpr bool sanitizes_addresses = false;
#endif
#else
inline constexpr bool sanitizes_addresses = false;
#endif

}  // namespace talus
