#include "render/image.h"

#include <string>

#include "core/errors.h"

namespace talus {

Image stacked(const std::vector<Image>& images) {
  Image stack;
  for (const Image& image : images) {
    if (stack.height == 0) {
      stack.width = image.width;
      stack.channels = image.channels;
    }
    if (image.width != stack.width || image.channels != stack.channels)
      throw Error(ExitCode::internal, "an image of " + std::to_string(image.width) + " px and " +
                                          std::to_string(image.channels) + " channels cannot be stacked on " +
                                          std::to_string(stack.width) + " px and " +
                                          std::to_string(stack.channels));
    stack.height += image.height;
    stack.pixels.insert(stack.pixels.end(), image.pixels.begin(), image.pixels.end());
  }
  return stack;
}

}  // namespace talus
