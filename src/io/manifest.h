#pragma once
/// The manifest of a run folder, whose replacement is the commit.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace talus::io {

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

  /// Whether the packed file next to the folder belongs to an earlier run, and is kept until this one is
  /// packed.
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

/// Reads `folder`/manifest. Throws Error(missing_input) if it does not exist, and Error(bad_data) if it is
/// damaged.
Manifest read_manifest(const std::string& folder);

/// Whether the run of this name is that in the folder and not the packed file next to it: the folder has not
/// been packed into this file, which it is to replace, or which is no run. Returns false for an unreadable
/// folder.
bool hides_packed(const std::string& folder, const std::string& packed);

/// Returns the bytes of a file in the folder. Throws Error(bad_data) if they do not match the manifest.
std::vector<std::byte> read_stored(const std::string& folder, const StoredFile& file);

}  // namespace talus::io
