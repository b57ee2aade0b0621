#include "base/base64.h"

#include <cstdint>

namespace talus {

std::string base64(std::span<const std::byte> bytes) {
  static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) -> std::uint32_t {
      return i + k < bytes.size() ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0U;
    };
    const std::uint32_t word = byte(0) << 16U | byte(1) << 8U | byte(2);
    text += digits[word >> 18U];
    text += digits[word >> 12U & 63U];
    text += i + 1 < bytes.size() ? digits[word >> 6U & 63U] : '=';
    text += i + 2 < bytes.size() ? digits[word & 63U] : '=';
  }
  return text;
}

}  // namespace talus
