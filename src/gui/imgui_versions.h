#pragma once
/// Differences between the versions of Dear ImGui, from 1.86 to 1.92: keys, input, textures and fonts. The
/// rest of the window uses what they have in common.

#include <imgui.h>

#include <cstdint>

#include "gui/input.h"

namespace talus::gui {

/// Prepares a new ImGui context for the events of an InputQueue.
void prepare_input(ImGuiIO& io);
/// Passes one event on; it takes effect in the next ImGui::NewFrame.
void forward_event(ImGuiIO& io, const InputEvent& event);
/// Whether a key is pressed in this picture, or repeats because it is held.
bool key_pressed(KeyCode key, bool repeat = true);
/// Keeps the mouse wheel for the last widget, so that the part around it does not scroll as well.
void keep_wheel();

/// The id of an OpenGL texture.
inline ImTextureID texture_id(unsigned texture) { return (ImTextureID)std::uintptr_t{texture}; }
inline unsigned texture_number(ImTextureID id) { return (unsigned)(std::uintptr_t)id; }
/// The id of the texture with the letters.
ImTextureID font_texture(const ImFontAtlas& atlas);

/// The size for which a font was added to its atlas, px.
float font_size(const ImFont& font);
/// Whether a font has a letter, rather than a substitute.
bool has_letter(ImFont& font, ImWchar letter);
/// Sets the current font until ImGui::PopFont, in its own size.
void push_font(ImFont& font);
/// Scales all fonts when they are drawn. Call it after the style has been set.
void scale_fonts(float scale);

}  // namespace talus::gui
