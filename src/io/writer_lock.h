#pragma once
/// Ensures one writer per run, with an advisory lock on a separate file that is acquired before anything is
/// touched.

#include <string>

#include "base/descriptor.h"

namespace talus::io {

/// The lock of a run folder. It ends with its process, so a leftover file `lock` is harmless. If locks do not
/// reach from one writer to the other, the later one creates its own `lock`, and the earlier one detects that
/// by `require`.
class WriterLock {
 public:
  static constexpr const char* file_name = "lock";

  /// Acquires the lock. Throws Error(cannot_create) if another process holds it (the message names it), or if
  /// the lock file cannot be created.
  explicit WriterLock(const std::string& folder);

  /// Releases the lock also in forked children, which share the open file.
  ~WriterLock();
  WriterLock(WriterLock&&) = default;
  WriterLock& operator=(WriterLock&&) = default;

  /// Throws Error(cannot_create) if the folder is no longer the locked one: it was removed, and another
  /// process may have made a new one.
  void require() const;

  bool is_held() const;

  /// Removes the lock file, and then releases the lock; in the opposite order, others would find it free and
  /// take over the run. The file is closed last, because some file systems keep a removed open file under
  /// another name until then.
  void remove();

 private:
  std::string folder_;
  std::string path_;
  Descriptor file_;
};

/// Returns the process that holds the lock of a folder, "process 12 on host a"; empty if none does, or if the
/// file system does not report it. Changes nothing.
std::string writer_of(const std::string& folder);

/// Throws Error(cannot_create) if a process holds the lock.
void require_no_writer(const std::string& folder);

}  // namespace talus::io
