#pragma once
/// Temporary files and folders of processes that were killed.

#include <string>

namespace talus {

/// Removes from a folder what killed processes of Talus left there, of whatever command and output: files
/// called `*.talus.part`, and the folders of that name in which figures are made, with the files in them that
/// are called as they are. Only what belongs to this user, and what no process holds the lock of; all else
/// stays, and so does what cannot be removed, and everything on network file systems, where a writer of
/// another machine may hold a lock that is not seen here. Never throws for the sake of a leftover. Others may
/// make, write and clear away files of the same names at the same time.
void clear_leftovers(const std::string& folder);

}  // namespace talus
