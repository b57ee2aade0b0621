#pragma once
/// Faults of the system on demand. The functions of the C library through which the run store touches the
/// disk are defined again in faults.cpp, so that call number N can be made to fail, or to be the last of its
/// process.

namespace talus::faults {

enum class Kind {
  none,
  kill,
  error,
  visit,  ///< the call is made after others have come to the files
  // Not one call, but a file system, for all processes:
  no_locks,    ///< without locks
  keeps_open,  ///< a file that is open is not removed but renamed, until it is closed, as NFS and FUSE do
};

struct Fault {
  Kind kind = Kind::none;
  int call = 0;          ///< strikes call number `call`, from 1, of those that faults.cpp defines
  int errno_value = 0;   ///< of an error
  bool lasting = false;  ///< an error strikes all later calls too
  void (*visit)() = nullptr;
};

/// The exit code of a process that was struck by Kind::kill.
inline constexpr int killed = 99;

/// Counts from here on, in this process: where a fault strikes would else depend on its children.
void arm(const Fault& fault);
/// Whether this process is the one that armed.
bool counts_here();
/// Calls counted since arm.
int calls();

/// The first call that was made to fail, with its path where it has one; empty where none was.
const char* struck();

/// Whether the file system has no locks, with errno set.
bool has_no_locks();

/// Removes a file as such a file system does, and closes one.
int unlink_kept(const char* path);
int close_kept(int file);

/// Counts a call; true where it must fail, with errno set.
bool strikes(const char* call, const char* path = "");
/// The same for a call that opens. What HDF5 opens of a file in memory lies nowhere, and always fails.
bool strikes_opening(const char* path);
/// The same for a call that reads: a full disk can be read.
bool strikes_reading(const char* call);

}  // namespace talus::faults
