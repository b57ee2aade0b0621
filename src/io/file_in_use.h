#pragma once
/// Which file HDF5 is reading, for the message of a crash. The seal of a run file tells damage, not intent: a
/// file can be malformed and sealed again, and HDF5 crashes on some.

#include <string>
#include <utility>

namespace talus::io {

/// The name of the file that HDF5 reads in this thread, as a handler of signals may read it; else null.
inline constinit thread_local const char* file_in_use = nullptr;

/// Names the file for as long as it lives; `name` must outlive it.
class FileInUse {
 public:
  explicit FileInUse(const std::string& name) : before_(std::exchange(file_in_use, name.c_str())) {}
  FileInUse(const FileInUse&) = delete;
  FileInUse& operator=(const FileInUse&) = delete;
  ~FileInUse() { file_in_use = before_; }

 private:
  const char* before_;
};

}  // namespace talus::io
