#pragma once
/// Injects system faults on demand. faults.cpp redefines the functions of the C library through which the run
/// store accesses the disk, so that call number N can be made to fail, or to be the last of its process.

namespace talus::faults {

enum class Kind {
  none,
  kill,
  error,
  visit,  ///< other processes access the files just before the call
  // The following affect a file system, for all processes:
  no_locks,    ///< without locks
  keeps_open,  ///< an open file is renamed instead of removed until it is closed, as on NFS and FUSE
};

struct Fault {
  Kind kind = Kind::none;
  int call = 0;          ///< number of the affected call, from 1, among those redefined in faults.cpp
  int errno_value = 0;   ///< errno of an error
  bool lasting = false;  ///< whether an error affects all later calls too
  void (*visit)() = nullptr;
};

/// Exit code of a process ended by Kind::kill.
inline constexpr int killed = 99;

/// Starts counting, in this process only: otherwise the place of a fault would depend on its children.
void arm(const Fault& fault);
/// Returns whether this process has called arm().
bool counts_in_process();
/// Returns the number of calls since arm().
int calls();

/// Returns the first call that was made to fail, with its path, if any; empty if none was.
const char* struck();

/// Returns whether the file system has no locks; then sets errno.
bool has_no_locks();

/// Remove and close a file as such a file system does.
int unlink_kept(const char* path);
int close_kept(int file);

/// Counts a call; returns true, with errno set, if it must fail.
bool strikes(const char* call, const char* path = "");
/// Does the same for a call that opens a file. Files that HDF5 opens for an in-memory image do not exist and
/// always fail.
bool strikes_opening(const char* path);
/// Does the same for a call that reads: a full disk remains readable.
bool strikes_reading(const char* call);

}  // namespace talus::faults
