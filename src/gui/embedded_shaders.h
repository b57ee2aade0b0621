#pragma once
/// Shaders of the widgets, embedded in the binary.

#include <span>

namespace talus::embedded {

extern const std::span<const unsigned char> gui_vert, gui_frag;

}  // namespace talus::embedded
