#pragma once
/// Reads an 8-bit gray PNG, for comparison.

#include <png.h>

#include <stdexcept>
#include <string>

#include "render/image.h"

namespace talus::test {

inline Image read_png(const std::string& path) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_file(&png, path.c_str()))
    throw std::runtime_error(path + ": " + png.message);
  if (png.format != PNG_FORMAT_GRAY) throw std::runtime_error(path + ": not an opaque gray picture");
  Image image{static_cast<int>(png.width), static_cast<int>(png.height), {}};
  image.gray.resize(PNG_IMAGE_SIZE(png));
  if (!png_image_finish_read(&png, nullptr, image.gray.data(), 0, nullptr))
    throw std::runtime_error(path + ": " + png.message);
  return image;
}

}  // namespace talus::test
