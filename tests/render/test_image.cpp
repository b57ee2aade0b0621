/// Pictures placed side by side.

#include <gtest/gtest.h>

#include "base/errors.h"
#include "render/image.h"

namespace talus::render {
namespace {

TEST(Image, images_stand_beside_each_other_on_white_ground) {
  const Image a{1, 2, 1, {10, 20}}, b{2, 1, 1, {30, 40}};
  const Image row = side_by_side({a, b});
  EXPECT_EQ(row.width, 3);
  EXPECT_EQ(row.height, 2);
  EXPECT_EQ(row.pixels, (std::vector<std::uint8_t>{10, 30, 40, 20, 255, 255}));
}

TEST(Image, ground_is_clear_where_images_are) {
  const Image a{1, 1, 4, {1, 2, 3, 4}};
  const Image higher{1, 2, 4, {1, 2, 3, 4, 0, 0, 0, 0}};
  EXPECT_EQ(side_by_side({a, higher}).pixels,
            (std::vector<std::uint8_t>{1, 2, 3, 4, 1, 2, 3, 4, 0, 0, 0, 0, 0, 0, 0, 0}));
}

TEST(Image, channels_must_agree) {
  EXPECT_THROW(side_by_side({{1, 1, 1, {0}}, {1, 1, 3, {0, 0, 0}}}), Error);
}

}  // namespace
}  // namespace talus::render
