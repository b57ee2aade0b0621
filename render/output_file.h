#pragma once
/// Output files that appear whole or not at all.

#include <cstdint>
#include <span>
#include <string>

namespace talus {

/// A file under a temporary name beside `path`, which gets its final name by commit and vanishes without.
class OutputFile {
 public:
  /// Throws Error(cannot_create).
  explicit OutputFile(const std::string& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  const std::string& temporary_path() const { return temporary_path_; }
  /// Throws Error(io_error).
  void write(std::span<const std::uint8_t> bytes);
  /// Throws Error(io_error).
  void commit();

 private:
  std::string path_;
  std::string temporary_path_;
  int descriptor_ = -1;
  bool committed_ = false;
};

}  // namespace talus
