#pragma once
/// The folder of a run that is being computed: its manifest, and the lock that ensures one writer per run, an
/// advisory lock on a separate file that is acquired before anything is touched.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/output_file.h"

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

/// Returns "process 12 on host a" for this process.
std::string this_process();

/// Returns the process that holds the lock of a folder, "process 12 on host a"; empty if none does, or if the
/// file system does not report it. Changes nothing.
std::string writer_of(const std::string& folder);

/// Throws Error(cannot_create) if a process holds the lock.
void require_no_writer(const std::string& folder);

// The manifest of a run folder, whose replacement is the commit.

/// A file of the folder, with size and hash to verify it.
struct StoredFile {
  std::string name;
  std::uint64_t size = 0;
  std::uint64_t hash = 0;  ///< XXH3 of its bytes
};
StoredFile describe(const std::string& name, std::span<const std::byte> bytes);

struct StoredSegment {
  StoredFile file;
  std::uint64_t frames = 0;
  std::uint64_t contacts = 0;     ///< total of all frames
  std::uint64_t observables = 0;  ///< number of rows
  std::uint64_t steps = 0;        ///< number of rows
};

struct Manifest {
  static constexpr const char* file_name = "manifest";
  static constexpr const char* header_name = "header.h5";

  /// Whether the packed file is that of an earlier run, kept until this one is packed.
  bool replaces = false;
  /// Hash of the seal of this run's packed file, from just before that file is renamed; 0 earlier. An
  /// existing run file belongs to this run if it has this seal, or none is known and none is replaced.
  std::uint64_t packed_seal = 0;
  StoredFile header;
  StoredFile checkpoint;
  std::vector<StoredSegment> segments;
};

/// Returns all valid files: header, segments in the order of their commits, checkpoint.
std::vector<StoredFile> files_of(const Manifest& manifest);

/// Returns the manifest as lines of words; the last line contains the hash of all preceding ones.
std::string manifest_text(const Manifest& manifest);

/// Parses a manifest; `path` is its name in messages. Throws Error(bad_data) if it is damaged.
Manifest parse_manifest(const std::string& text, const std::string& path);

/// Reads `folder`/manifest. Throws Error(missing_input) or Error(bad_data).
Manifest read_manifest(const std::string& folder);

/// Whether the run of this name is that in the folder and not the packed file next to it: the folder has not
/// been packed into this file, which it is to replace, or which is no run. False if it is unreadable.
bool hides_packed(const std::string& folder, const std::string& packed);

/// Returns the bytes of a file in the folder. Throws Error(bad_data) if they do not match the manifest.
std::vector<std::byte> read_stored(const std::string& folder, const StoredFile& file);

}  // namespace talus::io
