#pragma once
/// Reads an entire PNG for comparison.

#include <png.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "render/image.h"

namespace talus::test {

/// Returns a gray, RGB or RGBA picture of 8 bits, from a file or from memory.
inline render::Image finish_reading_png(png_image& png) {
  const int channels = static_cast<int>(PNG_IMAGE_PIXEL_CHANNELS(png.format));
  if (channels == 2) throw std::runtime_error("gray with alpha is not expected");
  render::Image image{static_cast<int>(png.width), static_cast<int>(png.height), channels, {}};
  image.pixels.resize(PNG_IMAGE_SIZE(png));
  if (!png_image_finish_read(&png, nullptr, image.pixels.data(), 0, nullptr))
    throw std::runtime_error(png.message);
  return image;
}

inline render::Image read_png(const std::string& path) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_file(&png, path.c_str()))
    throw std::runtime_error(path + ": " + png.message);
  return finish_reading_png(png);
}

inline render::Image read_png(const std::vector<std::uint8_t>& bytes) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()))
    throw std::runtime_error(png.message);
  return finish_reading_png(png);
}

}  // namespace talus::test
