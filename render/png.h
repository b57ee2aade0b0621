#pragma once
/// PNG files.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "render/image.h"

namespace talus::render {

/// The bytes of an 8-bit PNG: gray, RGB or RGBA, depending on the channels, with its texts (tEXt chunks), and
/// its resolution (pHYs) if `dots_per_m` > 0. The compression is chosen for speed: for maps, better settings
/// are ten times slower and save hardly any space. Throws Error(internal) if a PNG cannot hold the image or a
/// text.
std::vector<std::uint8_t> encode_png(const Image& image, const PictureTexts& texts = {},
                                     double printed_width = 0.0);

/// Says in a PNG how wide it is printed, m: its resolution (a pHYs chunk), by which other programs place it.
/// Leaves bytes alone that are no PNG.
void print_at(std::vector<std::uint8_t>& png, double printed_width);

/// Writes a PNG; an existing file is replaced once the new one is whole.
/// Throws Error(cannot_create) or Error(io_error), and leaves no partial file.
void write_png(const std::string& path, const Image& image, const PictureTexts& texts = {},
               double printed_width = 0.0);

/// The first text of a keyword. None if the file is missing, is not a PNG, is damaged or truncated, or has no
/// such keyword.
std::optional<std::string> png_text(const std::string& path, const std::string& keyword);

}  // namespace talus::render
