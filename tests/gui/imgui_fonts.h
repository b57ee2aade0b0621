#pragma once
/// Fonts of Dear ImGui in its versions 1.86 to 1.92.

#include <imgui.h>

namespace talus::test {

#if IMGUI_VERSION_NUM < 19200

inline ImTextureID font_texture(const ImFontAtlas& atlas) { return atlas.TexID; }
inline float font_size(const ImFont& font) { return font.FontSize; }
inline bool has_letter(ImFont& font, ImWchar letter) { return font.FindGlyphNoFallback(letter) != nullptr; }

#else

inline ImTextureID font_texture(const ImFontAtlas& atlas) { return atlas.TexRef.GetTexID(); }
inline float font_size(const ImFont& font) { return font.LegacySize; }
inline bool has_letter(ImFont& font, ImWchar letter) {
  return font.GetFontBaked(font.LegacySize)->FindGlyphNoFallback(letter) != nullptr;
}

#endif

}  // namespace talus::test
