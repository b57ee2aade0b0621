#include "gui/theme.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <utility>

#include "render/embedded.h"

namespace talus::gui {
namespace {

/// Colours of the light theme, the dark one, and the one for print: white, black, and under the mouse a light
/// blue, which never appears in saved pictures.
constexpr std::pair<render::Colour Palette::*, std::array<render::Colour, 3>> colours_of_themes[] = {
    {&Palette::ground, {{{255, 255, 255}, {20, 23, 28}, {255, 255, 255}}}},
    {&Palette::panel, {{{246, 247, 249}, {29, 33, 40}, {255, 255, 255}}}},
    {&Palette::raised, {{{233, 236, 240}, {46, 52, 62}, {255, 255, 255}}}},
    {&Palette::hovered, {{{219, 225, 233}, {58, 66, 79}, {225, 238, 252}}}},
    {&Palette::pressed, {{{190, 212, 240}, {38, 82, 130}, {205, 226, 248}}}},
    {&Palette::tint, {{{205, 224, 246}, {38, 70, 108}, {205, 226, 248}}}},
    {&Palette::track, {{{231, 234, 238}, {46, 52, 62}, {255, 255, 255}}}},
    {&Palette::range, {{{0, 95, 184, 38}, {96, 170, 255, 52}, {0, 95, 184, 38}}}},
    {&Palette::note, {{{255, 255, 255, 215}, {20, 23, 28, 215}, {255, 255, 255, 230}}}},
    {&Palette::line, {{{206, 211, 219}, {62, 69, 81}, {0, 0, 0}}}},
    {&Palette::ink, {{{26, 29, 34}, {228, 232, 238}, {0, 0, 0}}}},
    {&Palette::soft, {{{88, 94, 104}, {166, 174, 186}, {0, 0, 0}}}},
    {&Palette::accent, {{{0, 95, 184}, {96, 170, 255}, {0, 0, 0}}}},
    {&Palette::alarm, {{{168, 30, 14}, {178, 44, 30}, {255, 255, 255}}}},
    {&Palette::alarm_text, {{{255, 255, 255}, {255, 255, 255}, {150, 20, 0}}}},
    {&Palette::warning, {{{168, 30, 14}, {255, 138, 118}, {150, 20, 0}}}},
    {&Palette::grid, {{{150, 155, 163}, {112, 120, 132}, {0, 0, 0}}}},
    {&Palette::failure, {{{168, 30, 14}, {255, 118, 98}, {150, 20, 0}}}},
    {&Palette::command, {{{0, 106, 168}, {96, 188, 245}, {0, 90, 150}}}},
    {&Palette::rearrangement, {{{160, 84, 0}, {226, 150, 62}, {150, 75, 0}}}},
};
constexpr std::array<std::array<render::Colour, 4>, 3> curves_of_themes = {{
    {{{26, 29, 34}, {190, 84, 0}, {0, 106, 168}, {112, 117, 125}}},
    {{{236, 239, 244}, {255, 152, 64}, {86, 180, 245}, {150, 157, 168}}},
    {{{0, 0, 0}, {190, 84, 0}, {0, 106, 168}, {110, 110, 110}}},
}};

Palette make_palette(std::size_t theme) {
  Palette palette;
  for (const auto& [part, colours] : colours_of_themes) palette.*part = colours[theme];
  palette.curves = curves_of_themes[theme];
  return palette;
}

/// First and last code points of each block, terminated by 0: ASCII, Latin-1, Greek, dashes, super- and
/// subscripts, script l, arrows, mathematical operators, eject, simple shapes, check marks, angle brackets.
/// ImGui reads them as long as the atlas exists.
constexpr ImWchar glyph_blocks[] = {0x0020, 0x007E, 0x00A0, 0x00FF, 0x0391, 0x03C9, 0x2010, 0x2027, 0x2070,
                                    0x209C, 0x2113, 0x2113, 0x2190, 0x2199, 0x2200, 0x2265, 0x23CF, 0x23CF,
                                    0x25A0, 0x25FF, 0x2713, 0x2717, 0x27E8, 0x27E9, 0};

}  // namespace

const Palette& palette_of(view::Theme theme) {
  static const std::array palettes = {make_palette(0), make_palette(1), make_palette(2)};
  return palettes.at(static_cast<std::size_t>(theme));
}

ImGuiStyle style_of(view::Theme theme, float scale) {
  ImGuiStyle style;
  // Distances at display scale 1, px.
  constexpr float rounding = 4.0f;
  style.WindowPadding = {10.0f, 8.0f};    // between a part of the window and its content
  style.FramePadding = {8.0f, 4.0f};      // between a widget and its text
  style.ItemSpacing = {8.0f, 6.0f};       // between widgets
  style.ItemInnerSpacing = {6.0f, 4.0f};  // between a widget and its label
  style.CellPadding = {4.0f, 2.0f};       // within tables
  style.ScrollbarSize = 10.0f;
  style.GrabMinSize = 12.0f;
  style.FrameRounding = style.GrabRounding = style.PopupRounding = rounding;
  style.ScrollbarRounding = style.TabRounding = style.ChildRounding = rounding;
  style.WindowRounding = 0.0f;
  style.ScaleAllSizes(scale);
  style.WindowBorderSize = style.FrameBorderSize = style.PopupBorderSize = std::max(1.0f, std::round(scale));
  const Palette& colours = palette_of(theme);
  ImGui::StyleColorsLight(&style);
  const auto paint = [&style](const render::Colour& colour, std::initializer_list<ImGuiCol> parts) {
    for (const ImGuiCol part : parts) style.Colors[part] = ImGui::ColorConvertU32ToFloat4(packed(colour));
  };
  paint(colours.ink, {ImGuiCol_Text});
  paint(colours.soft, {ImGuiCol_TextDisabled, ImGuiCol_ScrollbarGrabHovered, ImGuiCol_ScrollbarGrabActive});
  paint(colours.ground, {ImGuiCol_WindowBg, ImGuiCol_PopupBg, ImGuiCol_FrameBg});
  paint(colours.line,
        {ImGuiCol_Border, ImGuiCol_Separator, ImGuiCol_TableBorderStrong, ImGuiCol_TableBorderLight});
  paint(colours.hovered,
        {ImGuiCol_FrameBgHovered, ImGuiCol_ButtonHovered, ImGuiCol_HeaderHovered, ImGuiCol_TabHovered});
  paint(colours.pressed, {ImGuiCol_FrameBgActive, ImGuiCol_ScrollbarGrab, ImGuiCol_SliderGrab,
                          ImGuiCol_SliderGrabActive, ImGuiCol_ButtonActive, ImGuiCol_HeaderActive});
  paint(colours.raised, {ImGuiCol_TitleBg, ImGuiCol_TitleBgActive, ImGuiCol_TitleBgCollapsed, ImGuiCol_Button,
                         ImGuiCol_Tab, ImGuiCol_TableHeaderBg});
  paint(colours.accent, {ImGuiCol_CheckMark, ImGuiCol_SeparatorHovered, ImGuiCol_SeparatorActive,
                         ImGuiCol_NavHighlight, ImGuiCol_DragDropTarget});
  paint(colours.tint, {ImGuiCol_Header, ImGuiCol_TabActive, ImGuiCol_TextSelectedBg});
  paint({0, 0, 0, 0}, {ImGuiCol_ScrollbarBg, ImGuiCol_BorderShadow, ImGuiCol_TableRowBg,
                       ImGuiCol_TableRowBgAlt, ImGuiCol_ChildBg});
  return style;
}

void add_embedded_font(ImFontAtlas& atlas, float scale) {
  ImFontConfig config;
  config.FontDataOwnedByAtlas = false;
  config.OversampleH = 2;
  // The interface takes a non-const pointer, but only reads.
  void* bytes = const_cast<unsigned char*>(embedded::font.data());
  for (const float size : type_scale)
    atlas.AddFontFromMemoryTTF(bytes, static_cast<int>(embedded::font.size()), std::round(size * scale),
                               &config, glyph_blocks);
  atlas.Build();
}

}  // namespace talus::gui
