#pragma once
/// Encoding of bytes as text.

#include <cstddef>
#include <span>
#include <string>

namespace talus {

/// Encodes bytes in Base64 (RFC 4648), with padding.
std::string base64(std::span<const std::byte> bytes);

}  // namespace talus
