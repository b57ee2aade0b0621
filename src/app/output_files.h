#pragma once
/// Files and folders that a command is about to write.

#include <string>

namespace talus {

/// Throws Error(cannot_create) where a file exists, unless `overwrite`.
void refuse_existing(const std::string& path, bool overwrite);

/// Makes a folder with its parents where it is missing. Throws Error(cannot_create), also where files cannot
/// be made in it.
void create_folder(const std::string& folder);

}  // namespace talus
