#pragma once
/// Bytes made smaller.

#include <cstddef>
#include <span>
#include <vector>

namespace talus {

/// The bytes as a zlib stream (RFC 1950), which a browser undoes by DecompressionStream("deflate"). The same
/// for the same bytes and the same version of zlib. Throws std::bad_alloc.
std::vector<std::byte> deflated(std::span<const std::byte> bytes);

}  // namespace talus
