#pragma once
/// Comparison with pictures that were inspected by eye. It only detects a change; if the change is intended,
/// copy the file named in the message over the golden one.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fmt/core.h>
#include <string>

#include "render/png.h"
#include "render/read_png.h"
#include "support/places.h"

namespace talus::test {

/// How a picture differs from another of the same size and number of channels. The value of a pixel is that
/// of the channel that differs most.
struct PictureDifference {
  std::size_t pixels = 0;  ///< pixels that differ at all
  std::size_t clear = 0;   ///< pixels that differ by more than `clear_step`
  int largest = 0;         ///< largest difference, of 255
  static constexpr int clear_step = 4;
};

inline PictureDifference difference_of(const render::Image& one, const render::Image& other) {
  PictureDifference found;
  const auto channels = static_cast<std::size_t>(one.channels);
  for (std::size_t pixel = 0; pixel < one.pixels.size() / channels; ++pixel) {
    int most = 0;
    for (std::size_t k = channels * pixel; k < channels * (pixel + 1); ++k)
      most = std::max(most, std::abs(int{one.pixels[k]} - int{other.pixels[k]}));
    found.pixels += most > 0 ? 1 : 0;
    found.clear += most > PictureDifference::clear_step ? 1 : 0;
    found.largest = std::max(found.largest, most);
  }
  return found;
}

/// Whether a difference may be that of another rasteriser: versions of Mesa and processors round the edges of
/// shapes differently. A grain that is displaced by half a pixel exceeds this (MapPictures).
inline bool is_rounding(const PictureDifference& found) { return found.clear == 0; }

/// Compares with tests/golden/NAME.png, and leaves the picture next to the tests.
inline void expect_golden(const render::Image& image, const std::string& name) {
  const std::string drawn = std::string(test::build_folder() + "/").append(name).append(".png");
  render::write_png(drawn, image);
  const render::Image golden =
      read_png(std::string(test::source_folder() + "/tests/golden/").append(name).append(".png"));
  ASSERT_EQ(image.width, golden.width) << "see " << drawn;
  ASSERT_EQ(image.height, golden.height) << "see " << drawn;
  ASSERT_EQ(image.channels, golden.channels) << "see " << drawn;
  const PictureDifference found = difference_of(image, golden);
  const std::string text = fmt::format(
      "{}: {} pixels differ from the golden picture, {} of them by more than {}, at most by {} of 255", drawn,
      found.pixels, found.clear, PictureDifference::clear_step, found.largest);
  if (found.pixels > 0) std::puts(text.c_str());
  EXPECT_TRUE(is_rounding(found)) << text;
}

}  // namespace talus::test
