#pragma once
/// Files that only one process writes at a time.

#include <functional>
#include <optional>
#include <string>

#include "base/output_file.h"

namespace talus {

/// Creates an empty file, open for reading and writing, and acquires its lock (flock), which ends with the
/// descriptor or its process. An existing file of this name whose lock is free was left by a killed process:
/// it is removed, and a process that still has it open does not reach the new file. If clear_leftovers is
/// about to remove it, this function waits. Returns no value if another process holds the file. Throws
/// creation_error if the file cannot be created, and Error(cannot_create) if a link, a folder or a device has
/// the name, which is left in place.
///
/// Some file systems have no locks (NFS without lockd, Lustre without flock), and some do not show the locks
/// of other machines. On these an existing file is taken over from its creator, which detects this by
/// is_named.
std::optional<Descriptor> create_locked(const std::string& path);

/// Calls `work` while this process holds a locked file. Other callers with the same path wait. The file is
/// removed afterwards, even if the work throws.
void while_locked(const std::string& path, const std::function<void()>& work);

/// Ending of the names of temporary files and folders, after the final name.
inline constexpr const char* temporary_ending = ".talus.part";

/// Removes from a folder the leftovers of killed Talus processes of any command: files called `*.talus.part`,
/// and folders of that name in which the Python package makes figures, if all files in them begin with the
/// name of the folder. Removes only items that belong to this user and that no process has locked. Keeps
/// items that cannot be removed, and everything on network file systems, because a writer on another machine
/// may hold a lock that is not visible here. Does not throw because of a leftover. Other processes may
/// create, write and remove files of the same names simultaneously.
void clear_leftovers(const std::string& folder);

/// Whether `path` names the open file, and not another file, a link, or nothing.
bool is_named(const std::string& path, const Descriptor& file);

/// Whether a process holds the lock of a file; false if the file does not exist, no value if the file system
/// has no locks.
std::optional<bool> is_locked(const std::string& path);

/// Returns the reason why a file that this process writes could not be locked. It is returned once; empty
/// otherwise. Files are locked deep inside the program, but only commands print.
std::string fetch_lock_problem();

}  // namespace talus
