#pragma once
/// One writer per run: an advisory lock on a file of our own, taken before anything is touched.

#include <string>

#include "core/descriptor.h"

namespace talus {

/// Holds the lock of a run folder. It dies with its process, so a file `lock` left behind does no harm.
class WriterLock {
 public:
  static constexpr const char* file_name = "lock";

  /// Throws Error(cannot_create) where another process holds the lock (the message names it), or where the
  /// lock file cannot be made.
  explicit WriterLock(const std::string& folder);

  /// Throws Error(cannot_create) where the folder is no longer the one that was locked: somebody has removed
  /// it, and another process may have made a new one.
  void require() const;

 private:
  std::string folder_;
  std::string path_;
  Descriptor file_;
};

/// Throws Error(cannot_create) where a process holds the lock of a folder, in which nothing is changed.
void require_no_writer(const std::string& folder);

}  // namespace talus
