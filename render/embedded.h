#pragma once
/// Files built into the binary: the GLSL of shaders/ and the font of the pictures.

#include <span>

namespace talus::embedded {

extern const std::span<const unsigned char> disc_vert, disc_frag;
extern const std::span<const unsigned char> glyph_vert, glyph_frag;
extern const std::span<const unsigned char> segment_vert, segment_frag;
extern const std::span<const unsigned char> font;  ///< DejaVu Sans, TrueType

}  // namespace talus::embedded
