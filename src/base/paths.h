#pragma once
/// Queries of paths. None of them throws exceptions of std::filesystem: a loop of links, a name that is too
/// long or a folder without permission gives a result, or an Error with a message.

#include <string>
#include <system_error>
#include <vector>

namespace talus {

/// Whether a path exists; false if that cannot be determined.
bool is_there(const std::string& path);

/// Returns the path from the root, without following links; the path itself if the working folder is missing.
std::string absolute_path(const std::string& path);

/// Returns the absolute path without links, dots and doubled slashes, which is equal for all names of a file.
/// Parts that do not exist or cannot be followed are kept.
std::string resolved_path(const std::string& path);

/// Returns the names in a folder, in no order; none, with the reason in `error`, if it cannot be read.
std::vector<std::string> names_in(const std::string& folder, std::error_code& error);
/// Returns the names in a folder. Throws Error(io_error) if it cannot be read.
std::vector<std::string> names_in(const std::string& folder);

}  // namespace talus
