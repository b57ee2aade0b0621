#pragma once
/// The font of the widgets, which is that of the pictures.

#include <imgui.h>

namespace talus {

/// Height of the text on a display of scale 1, px.
inline constexpr float font_size = 16.0f;

/// Adds the embedded font in font_size * scale to an atlas and bakes it. It has ASCII, Latin-1, Greek, super-
/// and subscripts, arrows, mathematical signs and simple shapes: everything that texts of pictures use, and
/// more.
void add_embedded_font(ImFontAtlas& atlas, float scale);

}  // namespace talus
