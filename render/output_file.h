#pragma once
/// Output files that appear whole or not at all.

#include <cstdint>
#include <span>
#include <string>

#include "core/descriptor.h"

namespace talus {

/// A file under the temporary name `path`.part, which gets its final name by commit and vanishes without.
/// What a kill leaves under the temporary name is replaced when the same file is written again.
class OutputFile {
 public:
  /// Throws creation_error, and Error(cannot_create) where another process writes the same file.
  explicit OutputFile(const std::string& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  const std::string& temporary_path() const { return temporary_path_; }
  /// Throws Error(io_error).
  void write(std::span<const std::uint8_t> bytes);
  /// Makes the content durable, then gives it its name. Throws Error(io_error), Error(cannot_create).
  void commit();

 private:
  std::string path_;
  std::string temporary_path_;
  Descriptor file_;
  bool committed_ = false;
};

}  // namespace talus
