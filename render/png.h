#pragma once
/// PNG files.

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "render/image.h"

namespace talus::render {

/// Keywords with their texts, kept in the file beside the picture (tEXt chunks). Keywords have 1 to 79
/// characters; both are printable ASCII.
using PngTexts = std::vector<std::pair<std::string, std::string>>;

/// The bytes of an 8-bit PNG: gray, RGB or RGBA, depending on the channels. The compression is chosen for
/// speed: for maps, better settings are ten times slower and save hardly any space.
/// Throws Error(internal) if a PNG cannot hold the image or a text.
std::vector<std::uint8_t> encode_png(const Image& image, const PngTexts& texts = {});

/// Writes a PNG; an existing file is replaced once the new one is whole.
/// Throws Error(cannot_create) or Error(io_error), and leaves no partial file.
void write_png(const std::string& path, const Image& image, const PngTexts& texts = {});

/// The first text of a keyword. None if the file is missing, is not a PNG, is damaged or truncated, or has no
/// such keyword.
std::optional<std::string> png_text(const std::string& path, const std::string& keyword);

}  // namespace talus::render
