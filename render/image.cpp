#include "render/image.h"

#include <algorithm>
#include <fmt/core.h>

#include "base/errors.h"

namespace talus::render {
namespace {

std::uint8_t ground(int channels) { return channels == 4 ? 0 : 255; }

}  // namespace

Image side_by_side(const std::vector<Image>& images) {
  Image row;
  for (const Image& image : images) {
    if (row.width == 0) row.channels = image.channels;
    if (image.channels != row.channels)
      throw Error(ExitCode::internal, "images with {} and {} channels next to each other", row.channels,
                  image.channels);
    row.width += image.width;
    row.height = std::max(row.height, image.height);
  }
  row.pixels.assign(row.row_bytes() * static_cast<std::size_t>(row.height), ground(row.channels));
  std::size_t left = 0;  // offset in bytes
  for (const Image& image : images) {
    for (std::size_t y = 0; y < static_cast<std::size_t>(image.height); ++y)
      std::copy_n(image.pixels.begin() + static_cast<std::ptrdiff_t>(y * image.row_bytes()),
                  image.row_bytes(),
                  row.pixels.begin() + static_cast<std::ptrdiff_t>(y * row.row_bytes() + left));
    left += image.row_bytes();
  }
  return row;
}

}  // namespace talus::render
