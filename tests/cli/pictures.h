#pragma once
/// Helpers that inspect pictures and their folders.

#include <cstdint>
#include <filesystem>
#include <string>

#include "support/process.h"

namespace talus::test {

inline std::uint32_t big_endian(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t k = at; k < at + 4; ++k) value = value << 8 | static_cast<unsigned char>(bytes[k]);
  return value;
}

struct PictureSize {
  int width = 0, height = 0;
};
inline PictureSize picture_size(const std::filesystem::path& png) {
  const std::string bytes = text_of(png);
  if (bytes.size() < 24) return {};
  return {static_cast<int>(big_endian(bytes, 16)), static_cast<int>(big_endian(bytes, 20))};
}

/// Returns the compressed pixels of a PNG without its texts; equal for equal pictures.
inline std::string pixels_of(const std::filesystem::path& png) {
  const std::string bytes = text_of(png);
  std::string pixels;
  for (std::size_t at = 8; at + 12 <= bytes.size(); at += 12 + big_endian(bytes, at))
    if (bytes.compare(at + 4, 4, "IDAT") == 0) pixels += bytes.substr(at + 8, big_endian(bytes, at));
  return pixels;
}

}  // namespace talus::test
