#pragma once
/// PNG files.

#include <cstdint>
#include <string>
#include <vector>

#include "render/image.h"

namespace talus::render {

/// Encodes an 8-bit PNG (gray, RGB or RGBA, depending on the channels) with its texts (tEXt chunks) and, if
/// it is `printed_width` m wide in print, its resolution (pHYs). The compression is chosen for speed: for
/// maps, better settings are ten times slower and save hardly any space. Throws Error(internal) if a PNG
/// cannot hold the image or a text.
std::vector<std::uint8_t> encode_png(const Image& image, const PictureTexts& texts = {},
                                     double printed_width = 0.0);

/// Writes a PNG. An existing file is replaced once the new one is complete. Throws Error(cannot_create) or
/// Error(io_error), and leaves no partial file.
void write_png(const std::string& path, const Image& image, const PictureTexts& texts = {},
               double printed_width = 0.0);

}  // namespace talus::render
