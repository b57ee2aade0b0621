#pragma once
/// The shaders of the widgets, built into the binary.

#include <span>

namespace talus::embedded {

extern const std::span<const unsigned char> gui_vert, gui_frag;

}  // namespace talus::embedded
