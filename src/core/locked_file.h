#pragma once
/// Files that one process writes at a time.

#include <optional>
#include <string>

#include "core/descriptor.h"

namespace talus {

/// Makes an empty file, open for reading and writing, and takes its lock (flock), which dies with the
/// descriptor or its process. A file of this name that nobody holds was left by a process that was killed: it
/// is removed, and what still has it open does not reach the new one. No value where another process holds
/// the file; throws creation_error where it cannot be made.
std::optional<Descriptor> create_locked(const std::string& path);

/// Whether `path` names the open file, and not another one or none.
bool is_named(const std::string& path, const Descriptor& file);

}  // namespace talus
