#pragma once
/// Temporary files and folders of processes that were killed.

#include <string>

namespace talus {

/// Removes from a folder what killed processes of Talus left there, of whatever command and output: files
/// called `*.talus.part`, and the folders of that name in which figures are made, with the files in them that
/// are called as they are. Only what belongs to this user, and what no process holds the lock of; all else
/// stays, and so does what cannot be removed. Never throws for the sake of a leftover. Others may make, write
/// and clear away files of the same names at the same time.
void clear_leftovers(const std::string& folder);

}  // namespace talus
