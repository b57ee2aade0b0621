#include "render/image.h"

#include <fmt/core.h>
#include <string>

#include "base/errors.h"

namespace talus::render {

Image stacked(const std::vector<Image>& images) {
  Image stack;
  for (const Image& image : images) {
    if (stack.height == 0) {
      stack.width = image.width;
      stack.channels = image.channels;
    }
    if (image.width != stack.width || image.channels != stack.channels)
      throw Error(ExitCode::internal,
                  fmt::format("an image of {} px and {} channels cannot be stacked on {} px and {}",
                              image.width, image.channels, stack.width, stack.channels));
    stack.height += image.height;
    stack.pixels.insert(stack.pixels.end(), image.pixels.begin(), image.pixels.end());
  }
  return stack;
}

}  // namespace talus::render
