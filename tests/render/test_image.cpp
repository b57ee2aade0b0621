#include <gtest/gtest.h>

#include "base/errors.h"
#include "render/image.h"

namespace talus::render {
namespace {

TEST(Image, StacksFromTopToBottom) {
  const Image top{2, 1, 3, {1, 2, 3, 4, 5, 6}},
      bottom{2, 2, 3, {7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18}};
  const Image stack = stacked({top, bottom});
  EXPECT_EQ(stack.width, 2);
  EXPECT_EQ(stack.height, 3);
  EXPECT_EQ(stack.channels, 3);
  EXPECT_EQ(stack.pixels,
            (std::vector<std::uint8_t>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18}));
  EXPECT_EQ(stacked({top}).pixels, top.pixels);
  EXPECT_EQ(stacked({}).height, 0);
}

TEST(Image, StacksOnlyWhatFits) {
  const Image gray{2, 1, 1, {0, 0}}, wider{3, 1, 1, {0, 0, 0}}, colour{2, 1, 3, {0, 0, 0, 0, 0, 0}};
  for (const Image& other : {wider, colour}) try {
      stacked({gray, other});
      ADD_FAILURE() << "accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::internal);
    }
}

}  // namespace
}  // namespace talus::render
