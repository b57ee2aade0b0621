#pragma once
/// Pictures put beside each other.

#include "render/image.h"

namespace talus {

/// Images of one number of channels from left to right, their upper edges level; below those that are shorter
/// is ground: white, or clear where there is an alpha channel. Throws Error(internal) where the channels
/// differ.
Image beside(const std::vector<Image>& images);

/// An image with ground added below, up to a height; as it is where it has that height.
Image padded(Image image, int height);

}  // namespace talus
