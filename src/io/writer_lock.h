#pragma once
/// One writer per run: an advisory lock on a file of our own, taken before anything is touched.

#include <string>

#include "base/descriptor.h"

namespace talus::io {

/// Holds the lock of a run folder. It dies with its process, so a file `lock` left behind does no harm. Where
/// locks do not reach from one writer to the other, the later one makes a `lock` of its own, and the earlier
/// one finds out by `require`.
class WriterLock {
 public:
  static constexpr const char* file_name = "lock";

  /// Throws Error(cannot_create) where another process holds the lock (the message names it), or where the
  /// lock file cannot be made.
  explicit WriterLock(const std::string& folder);

  /// Ends the lock in children of fork as well, which have the open file.
  ~WriterLock();
  WriterLock(WriterLock&&) = default;
  WriterLock& operator=(WriterLock&&) = default;

  /// Throws Error(cannot_create) where the folder is no longer the one that was locked: somebody has removed
  /// it, and another process may have made a new one.
  void require() const;

  bool is_held() const;

  /// Ends the lock, and removes its file first: others who find it free would take the run over. The file is
  /// closed only then, and some file systems keep a file that is open, under another name, until it is.
  void remove();

 private:
  std::string folder_;
  std::string path_;
  Descriptor file_;
};

/// The process that holds the lock of a folder, "process 12 on host a"; empty if none does, or if the file
/// system does not tell. Nothing is changed.
std::string writer_of(const std::string& folder);

/// Throws Error(cannot_create) where there is one.
void require_no_writer(const std::string& folder);

}  // namespace talus::io
