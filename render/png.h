#pragma once
/// PNG files.

#include <cstdint>
#include <string>
#include <vector>

#include "render/image.h"

namespace talus {

/// The bytes of an 8-bit gray PNG. The compression is chosen for speed: of maps, better settings are ten
/// times slower and hardly smaller.
std::vector<std::uint8_t> encode_png(const Image& image);

/// Writes a PNG; an existing file is replaced once the new one is whole.
/// Throws Error(cannot_create) or Error(io_error), and leaves no partial file.
void write_png(const std::string& path, const Image& image);

}  // namespace talus
