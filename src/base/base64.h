#pragma once
/// Bytes as text.

#include <cstddef>
#include <span>
#include <string>

namespace talus {

/// RFC 4648, with padding.
std::string base64(std::span<const std::byte> bytes);

}  // namespace talus
