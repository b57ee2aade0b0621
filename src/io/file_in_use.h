#pragma once
/// The file that HDF5 is reading, for the message after a crash. The seal of a run file detects damage, not
/// manipulation: a malformed file can be sealed again, and some make HDF5 crash.

#include <string>
#include <utility>

namespace talus::io {

/// The name of the file that HDF5 reads in this thread, in a form that signal handlers can read; otherwise
/// null.
inline constinit thread_local const char* file_in_use = nullptr;

/// Registers the file during its lifetime; `name` must outlive it. An empty name registers nothing. Every
/// call of HDF5 on a file that this process has not made itself is made during the lifetime of one, and so is
/// the closing of what it opens: declare it first in a function.
class FileInUse {
 public:
  explicit FileInUse(const std::string& name)
      : before_(std::exchange(file_in_use, name.empty() ? file_in_use : name.c_str())) {}
  FileInUse(const FileInUse&) = delete;
  FileInUse& operator=(const FileInUse&) = delete;
  ~FileInUse() { file_in_use = before_; }

 private:
  const char* before_;
};

}  // namespace talus::io
