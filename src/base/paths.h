#pragma once
/// Questions about paths. None throws what std::filesystem would: a loop of links, a name that is too long or
/// a folder that nobody may enter is an answer, or an Error with a message.

#include <string>
#include <system_error>
#include <vector>

namespace talus {

/// Whether a path leads to something; false where that cannot be told.
bool is_there(const std::string& path);

/// The path from the root, without following links; the path itself where there is no working folder.
std::string absolute_path(const std::string& path);

/// absolute_path without links, dots and doubled slashes: of two names of one file it is the same. What does
/// not exist or cannot be followed stays as it is.
std::string resolved_path(const std::string& path);

/// The names in a folder, in no order; none where `error` says why it cannot be read.
std::vector<std::string> names_in(const std::string& folder, std::error_code& error);
/// Throws Error(io_error).
std::vector<std::string> names_in(const std::string& folder);

}  // namespace talus
