#pragma once
/// Files and folders that only one process writes at a time.

#include <optional>
#include <string>

#include "core/descriptor.h"

namespace talus {

/// Creates an empty file, open for reading and writing, and takes its lock (flock), which dies with the
/// descriptor or its process. A file of this name that nobody holds was left by a process that was killed: it
/// is removed, and whoever still has it open does not reach the new one; so it may be with one that
/// clear_leftovers (core/leftovers.h) is about to remove, which is waited for. No value if another process
/// holds the file; throws creation_error if it cannot be created, and Error(cannot_create) where a link, a
/// folder or a device has the name, which stays.
std::optional<Descriptor> create_locked(const std::string& path);

/// The same, once no other process holds it.
Descriptor create_locked_when_free(const std::string& path);

/// The same of an empty folder, which is open for reading. One that was left is removed with all that is in
/// it.
std::optional<Descriptor> create_locked_folder(const std::string& path);

/// Whether `path` names the open file rather than another one, a link, or none.
bool is_named(const std::string& path, const Descriptor& file);

}  // namespace talus
