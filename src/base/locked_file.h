#pragma once
/// Files and folders that only one process writes at a time.

#include <functional>
#include <optional>
#include <string>

#include "base/descriptor.h"

namespace talus {

/// Creates an empty file, open for reading and writing, and takes its lock (flock), which dies with the
/// descriptor or its process. A file of this name that nobody holds was left by a process that was killed: it
/// is removed, and whoever still has it open does not reach the new one; so it may be with one that
/// clear_leftovers is about to remove, which is waited for. No value if another process
/// holds the file; throws creation_error if it cannot be created, and Error(cannot_create) where a link, a
/// folder or a device has the name, which stays.
///
/// Some file systems have no locks (NFS without lockd, Lustre without flock), and on some the locks of other
/// machines are not seen. There a file that is found is taken from whoever made it, who finds out by
/// is_named.
std::optional<Descriptor> create_locked(const std::string& path);

/// Does the work while this process holds such a file, which others who call this with the same path wait
/// for. The file is removed at the end, also if the work throws.
void while_locked(const std::string& path, const std::function<void()>& work);

/// The same of an empty folder, which is open for reading. One that was left is removed with all that is in
/// it.
std::optional<Descriptor> create_locked_folder(const std::string& path);

/// What temporary files and folders are called, after the name of what they become.
inline constexpr const char* temporary_ending = ".talus.part";

/// Removes from a folder what killed processes of Talus left there, of whatever command and output: files
/// called `*.talus.part`, and the folders of that name in which figures are made, with the files in them that
/// are called as they are. Only what belongs to this user, and what no process holds the lock of; all else
/// stays, and so does what cannot be removed, and everything on network file systems, where a writer of
/// another machine may hold a lock that is not seen here. Never throws for the sake of a leftover. Others may
/// make, write and clear away files of the same names at the same time.
void clear_leftovers(const std::string& folder);

/// Whether `path` names the open file rather than another one, a link, or none.
bool is_named(const std::string& path, const Descriptor& file);

/// Whether a process holds the lock of a file; false if there is no such file. No value if the file system
/// does not tell, since it has no locks.
std::optional<bool> is_locked(const std::string& path);

/// Why a file could not be locked that this process writes all the same; told once, and empty if there was
/// none. Files are locked at any depth, and only commands print.
std::string take_lock_problem();

}  // namespace talus
