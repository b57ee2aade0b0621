#pragma once
/// The font of the widgets, which is that of the pictures, in the sizes of the type scale.

#include <imgui.h>

namespace talus::gui {

/// The sizes of the type scale (theme.h), in the order of the fonts of the atlas.
enum class TextSize { body, small, heading };

/// Adds the embedded font to an atlas in all sizes, each times `scale` in whole pixels, and bakes them. It
/// has ASCII, Latin-1, Greek, super- and subscripts, arrows, mathematical signs and simple shapes: everything
/// that texts of pictures use, and more.
void add_embedded_font(ImFontAtlas& atlas, float scale);

/// Texts of that size as long as it lives.
class TextOfSize {
 public:
  explicit TextOfSize(TextSize size) { ImGui::PushFont(ImGui::GetIO().Fonts->Fonts[static_cast<int>(size)]); }
  ~TextOfSize() { ImGui::PopFont(); }
  TextOfSize(const TextOfSize&) = delete;
  TextOfSize& operator=(const TextOfSize&) = delete;
};

}  // namespace talus::gui
