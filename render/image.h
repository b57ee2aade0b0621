#pragma once
/// A picture in memory.

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace talus::render {

/// An image with 8 bits per channel, rows from top to bottom. One channel: gray (0 black, 255 white); three
/// channels: sRGB; four channels: sRGB with straight alpha.
struct Image {
  int width = 0;
  int height = 0;
  int channels = 1;
  std::vector<std::uint8_t> pixels;  ///< width * height * channels values

  std::size_t row_bytes() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(channels);
  }
};

/// Keywords with texts, stored as metadata in the file of a picture. Keywords have 1 to 79 characters; both
/// are printable ASCII.
using PictureTexts = std::vector<std::pair<std::string, std::string>>;

/// Puts images with the same number of channels next to each other from left to right, aligned at the top.
/// The background below shorter images is white, or transparent if there is an alpha channel. Throws
/// Error(internal) if the numbers of channels differ.
Image side_by_side(const std::vector<Image>& images);

}  // namespace talus::render
