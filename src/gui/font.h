#pragma once
/// Font of the widgets, identical to that of the pictures, in the sizes of the type scale.

#include "gui/imgui_versions.h"

namespace talus::gui {

/// Sizes of the type scale (theme.h), in the order of the atlas's fonts.
enum class TextSize { body, small, heading };

/// Adds the embedded font to an atlas in all sizes, each multiplied by `scale` and rounded to whole pixels,
/// and bakes them. It covers ASCII, Latin-1, Greek, super- and subscripts, arrows, mathematical signs and
/// simple shapes, which includes all characters of pictures.
void add_embedded_font(ImFontAtlas& atlas, float scale);

/// Sets the text size during its lifetime.
class TextOfSize {
 public:
  explicit TextOfSize(TextSize size) { push_font(*ImGui::GetIO().Fonts->Fonts[static_cast<int>(size)]); }
  ~TextOfSize() { ImGui::PopFont(); }
  TextOfSize(const TextOfSize&) = delete;
  TextOfSize& operator=(const TextOfSize&) = delete;
};

}  // namespace talus::gui
