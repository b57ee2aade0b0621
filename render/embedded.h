#pragma once
/// Files embedded in the binary: the GLSL of shaders/, the font and the colour maps of the pictures.

#include <span>

namespace talus::embedded {

extern const std::span<const unsigned char> disc_vert, disc_frag, hatched_disc_frag;
extern const std::span<const unsigned char> glyph_vert, glyph_frag;
extern const std::span<const unsigned char> line_vert, line_frag;
extern const std::span<const unsigned char> font;  ///< DejaVu Sans, TrueType
/// Colour maps as text: lines "red green blue".
extern const std::span<const unsigned char> viridis, cividis, magma, inferno, plasma;

}  // namespace talus::embedded
