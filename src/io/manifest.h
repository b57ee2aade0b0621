#pragma once
/// The manifest of a run folder: the single point at which a commit happens.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace talus::io {

/// A file of the folder, with what proves that it is whole.
struct StoredFile {
  std::string name;
  std::uint64_t size = 0;
  std::uint64_t hash = 0;  ///< XXH3 of its bytes
};
StoredFile describe(const std::string& name, std::span<const std::byte> bytes);

struct StoredSegment {
  StoredFile file;
  std::uint64_t frames = 0;
  std::uint64_t contacts = 0;     ///< of all frames
  std::uint64_t observables = 0;  ///< rows
  std::uint64_t steps = 0;        ///< rows
};

struct Manifest {
  static constexpr const char* file_name = "manifest";
  static constexpr const char* header_name = "header.h5";

  /// The packed file beside the folder is of an earlier run, and is kept until this one is packed.
  bool replaces = false;
  /// The packed file of this run, by the hash of its seal, which is about to get its name or has got it; 0
  /// before. Only where there is one to be replaced: else a packed file is that of this run.
  std::uint64_t packed_seal = 0;
  StoredFile header;
  StoredFile checkpoint;
  std::vector<StoredSegment> segments;
};

/// All files that count: header, segments in the order of their commits, checkpoint.
std::vector<StoredFile> files_of(const Manifest& manifest);

/// Lines of words, the last with the hash of all before it.
std::string manifest_text(const Manifest& manifest);

/// The manifest in a text; `path` is what messages call it. Throws Error(bad_data) where it is damaged.
Manifest parse_manifest(const std::string& text, const std::string& path);

/// Reads `folder`/manifest. Throws Error(missing_input) where there is none, and Error(bad_data) where it is
/// damaged.
Manifest read_manifest(const std::string& folder);

/// Whether a folder holds a run that replaces the packed file beside it and has not done so yet. One that
/// cannot be read does not.
bool replaces_packed(const std::string& folder, const std::string& packed);

/// The bytes of a file of the folder. Throws Error(bad_data) where they are not those the manifest describes.
std::vector<std::byte> read_stored(const std::string& folder, const StoredFile& file);

}  // namespace talus::io
