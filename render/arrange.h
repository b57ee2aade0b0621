#pragma once
/// Pictures put beside each other.

#include "render/image.h"

namespace talus::render {

/// Images with the same number of channels from left to right, their upper edges level. The background below
/// shorter ones is white, or transparent if there is an alpha channel. Throws Error(internal) if the channels
/// differ.
Image beside(const std::vector<Image>& images);

/// An image with background added below up to a height; unchanged if it has that height.
Image padded(Image image, int height);

}  // namespace talus::render
