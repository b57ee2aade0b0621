#pragma once
/// One writer per run: an advisory lock on a file of our own, taken before anything is touched.

#include <string>

#include "io/descriptor.h"

namespace talus {

/// Holds the lock of a run folder. It dies with its process, so a file `lock` left behind does no harm.
class WriterLock {
 public:
  static constexpr const char* file_name = "lock";

  /// Throws Error(cannot_create) where another process holds the lock (the message names it), or where the
  /// lock file cannot be made.
  explicit WriterLock(const std::string& folder);

 private:
  Descriptor file_;
};

}  // namespace talus
