#pragma once
/// Comparison with pictures that were inspected by eye. It only detects a change; if the change is intended,
/// copy the file named in the message over the golden one.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "render/png.h"
#include "render/read_png.h"
#include "support/places.h"

namespace talus::test {

/// Compares with tests/golden/NAME.png, and leaves the picture next to the tests.
inline void expect_golden(const render::Image& image, const std::string& name) {
  const std::string drawn = std::string(test::build_folder() + "/").append(name).append(".png");
  render::write_png(drawn, image);
  const render::Image golden =
      read_png(std::string(test::source_folder() + "/tests/golden/").append(name).append(".png"));
  ASSERT_EQ(image.width, golden.width) << "see " << drawn;
  ASSERT_EQ(image.height, golden.height) << "see " << drawn;
  ASSERT_EQ(image.channels, golden.channels) << "see " << drawn;
  double difference = 0.0;
  for (std::size_t k = 0; k < image.pixels.size(); ++k)
    difference += std::abs(int{image.pixels[k]} - int{golden.pixels[k]});
  // Processors without AVX round differently; one displaced disc exceeds this several times.
  EXPECT_LT(difference / (255.0 * static_cast<double>(image.pixels.size())), 0.0005) << "see " << drawn;
}

}  // namespace talus::test
