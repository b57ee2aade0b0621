#pragma once
/// Faults of the system on demand. The functions of the C library through which the run store touches the
/// disk are defined again in faults.cpp, so that call number N can be made to fail, or to be the last of its
/// process.

namespace talus::faults {

enum class Kind { none, kill, error };

struct Fault {
  Kind kind = Kind::none;
  int call =
      0;  ///< strikes call number `call`, from 1, of open, read, write, fsync, rename, unlink, mkdir, rmdir
  int errno_value = 0;   ///< of an error
  bool lasting = false;  ///< an error strikes all later calls too
};

/// The exit code of a process that was struck by Kind::kill.
inline constexpr int killed = 99;

/// Counts from here on.
void arm(const Fault& fault);
/// Calls counted since arm.
int calls();

}  // namespace talus::faults
