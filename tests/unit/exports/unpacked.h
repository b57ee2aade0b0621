#pragma once
/// Decoding of a page's tables in C++: base64, zlib and differences.

#include <zlib.h>

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace talus::test {

inline std::vector<unsigned char> bytes_of_base64(std::string_view text) {
  static constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<unsigned char> bytes;
  std::uint32_t word = 0;
  int bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    word = word << 6U | static_cast<std::uint32_t>(digits.find(c));
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes.push_back(static_cast<unsigned char>(word >> bits & 255U));
  }
  return bytes;
}

/// Decodes a table; returns an empty one if the text is not the output of packed_text for a table of that
/// size.
inline std::vector<std::uint32_t> unpacked(std::string_view text, std::size_t rows, std::size_t columns,
                                           int bytes) {
  const std::vector<unsigned char> stream = bytes_of_base64(text);
  const std::size_t count = rows * columns;
  std::vector<unsigned char> planes(count * static_cast<std::size_t>(bytes) + 1);
  uLongf size = planes.size();
  if (uncompress(planes.data(), &size, stream.data(), stream.size()) != Z_OK || size + 1 != planes.size())
    return {};
  std::vector<std::uint32_t> codes(count, 0);
  for (std::size_t k = 0; k < count * static_cast<std::size_t>(bytes); ++k)
    codes[k % count] |= static_cast<std::uint32_t>(planes[k]) << 8U * (k / count);
  const std::uint32_t mask = bytes == 4 ? 0xFFFFFFFFU : (1U << 8U * static_cast<unsigned>(bytes)) - 1U;
  for (std::size_t k = 0; k < count; ++k) {
    if (k % columns > 0)
      codes[k] += codes[k - 1];
    else if (k > 0)
      codes[k] += codes[k - columns];
    codes[k] &= mask;
  }
  return codes;
}

}  // namespace talus::test
