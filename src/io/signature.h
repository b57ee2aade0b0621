#pragma once
/// How files begin.

#include <string>
#include <string_view>

namespace talus {

inline constexpr std::string_view hdf5_signature = "\x89HDF\r\n\x1a\n";

/// Whether the regular file at `path` begins with these bytes; false where there is none, or this user may
/// not read it. Throws Error(missing_input) where it cannot be opened for another reason, and Error(io_error)
/// where its device fails.
bool begins_with(const std::string& path, std::string_view bytes);
/// Whether it begins as the packed file of a run, sound or damaged.
bool begins_as_run(const std::string& path);

}  // namespace talus
