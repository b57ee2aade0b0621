#pragma once
/// A picture in memory.

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace talus::render {

/// 8 bits for each channel, rows from top to bottom. One channel: gray, 0 black, 255 white; three: sRGB;
/// four: sRGB and straight alpha.
struct Image {
  int width = 0;
  int height = 0;
  int channels = 1;
  std::vector<std::uint8_t> pixels;  ///< width * height * channels

  std::size_t row_bytes() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(channels);
  }
};

/// Keywords with their texts, kept in the file of a picture beside it. Keywords have 1 to 79 characters; both
/// are printable ASCII.
using PictureTexts = std::vector<std::pair<std::string, std::string>>;

/// Images with the same number of channels from left to right, their upper edges level. The background below
/// shorter ones is white, or transparent if there is an alpha channel. Throws Error(internal) if the channels
/// differ.
Image beside(const std::vector<Image>& images);

}  // namespace talus::render
