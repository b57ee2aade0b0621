#include "gui/theme.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace talus::gui {
namespace {

constexpr Palette light_palette = {.ground = {255, 255, 255},
                                   .panel = {246, 247, 249},
                                   .raised = {233, 236, 240},
                                   .hovered = {219, 225, 233},
                                   .pressed = {190, 212, 240},
                                   .field = {255, 255, 255},
                                   .tint = {205, 224, 246},
                                   .track = {231, 234, 238},
                                   .range = {0, 95, 184, 38},
                                   .note = {255, 255, 255, 215},
                                   .line = {206, 211, 219},
                                   .ink = {26, 29, 34},
                                   .soft = {88, 94, 104},
                                   .accent = {0, 95, 184},
                                   .alarm = {168, 30, 14},
                                   .alarm_text = {255, 255, 255},
                                   .warning = {168, 30, 14},
                                   .grid = {150, 155, 163},
                                   .frame_shown = {0, 95, 184},
                                   .transition = {26, 29, 34},
                                   .failure = {168, 30, 14},
                                   .command = {0, 106, 168},
                                   .rearrangement = {160, 84, 0},
                                   .curves = {{{26, 29, 34}, {190, 84, 0}, {0, 106, 168}, {112, 117, 125}}}};

constexpr Palette dark_palette = {
    .ground = {20, 23, 28},
    .panel = {29, 33, 40},
    .raised = {46, 52, 62},
    .hovered = {58, 66, 79},
    .pressed = {38, 82, 130},
    .field = {20, 23, 28},
    .tint = {38, 70, 108},
    .track = {46, 52, 62},
    .range = {96, 170, 255, 52},
    .note = {20, 23, 28, 215},
    .line = {62, 69, 81},
    .ink = {228, 232, 238},
    .soft = {166, 174, 186},
    .accent = {96, 170, 255},
    .alarm = {178, 44, 30},
    .alarm_text = {255, 255, 255},
    .warning = {255, 138, 118},
    .grid = {112, 120, 132},
    .frame_shown = {96, 170, 255},
    .transition = {228, 232, 238},
    .failure = {255, 118, 98},
    .command = {96, 188, 245},
    .rearrangement = {226, 150, 62},
    .curves = {{{236, 239, 244}, {255, 152, 64}, {86, 180, 245}, {150, 157, 168}}}};

/// White and black; the item under the mouse is light blue, which never appears in saved pictures.
constexpr Palette print_palette = {.ground = {255, 255, 255},
                                   .panel = {255, 255, 255},
                                   .raised = {255, 255, 255},
                                   .hovered = {225, 238, 252},
                                   .pressed = {205, 226, 248},
                                   .field = {255, 255, 255},
                                   .tint = {205, 226, 248},
                                   .track = {255, 255, 255},
                                   .range = {0, 95, 184, 38},
                                   .note = {255, 255, 255, 230},
                                   .line = {0, 0, 0},
                                   .ink = {0, 0, 0},
                                   .soft = {0, 0, 0},
                                   .accent = {0, 0, 0},
                                   .alarm = {255, 255, 255},
                                   .alarm_text = {150, 20, 0},
                                   .warning = {150, 20, 0},
                                   .grid = {0, 0, 0},
                                   .frame_shown = {0, 0, 0},
                                   .transition = {0, 0, 0},
                                   .failure = {150, 20, 0},
                                   .command = {0, 90, 150},
                                   .rearrangement = {150, 75, 0},
                                   .curves = {{{0, 0, 0}, {190, 84, 0}, {0, 106, 168}, {110, 110, 110}}}};

/// Colours of the palette for the parts of Dear ImGui.
constexpr std::pair<ImGuiCol, render::Colour Palette::*> roles[] = {
    {ImGuiCol_Text, &Palette::ink},
    {ImGuiCol_TextDisabled, &Palette::soft},
    {ImGuiCol_WindowBg, &Palette::ground},
    {ImGuiCol_PopupBg, &Palette::ground},
    {ImGuiCol_Border, &Palette::line},
    {ImGuiCol_FrameBg, &Palette::field},
    {ImGuiCol_FrameBgHovered, &Palette::hovered},
    {ImGuiCol_FrameBgActive, &Palette::pressed},
    {ImGuiCol_TitleBg, &Palette::raised},
    {ImGuiCol_TitleBgActive, &Palette::raised},
    {ImGuiCol_TitleBgCollapsed, &Palette::raised},
    {ImGuiCol_ScrollbarGrab, &Palette::pressed},
    {ImGuiCol_ScrollbarGrabHovered, &Palette::soft},
    {ImGuiCol_ScrollbarGrabActive, &Palette::soft},
    {ImGuiCol_CheckMark, &Palette::accent},
    {ImGuiCol_SliderGrab, &Palette::pressed},  // the value is written over it
    {ImGuiCol_SliderGrabActive, &Palette::pressed},
    {ImGuiCol_Button, &Palette::raised},
    {ImGuiCol_ButtonHovered, &Palette::hovered},
    {ImGuiCol_ButtonActive, &Palette::pressed},
    {ImGuiCol_Header, &Palette::tint},
    {ImGuiCol_HeaderHovered, &Palette::hovered},
    {ImGuiCol_HeaderActive, &Palette::pressed},
    {ImGuiCol_Separator, &Palette::line},
    {ImGuiCol_SeparatorHovered, &Palette::accent},
    {ImGuiCol_SeparatorActive, &Palette::accent},
    {ImGuiCol_Tab, &Palette::raised},
    {ImGuiCol_TabHovered, &Palette::hovered},
    {ImGuiCol_TabActive, &Palette::tint},
    {ImGuiCol_TableHeaderBg, &Palette::raised},
    {ImGuiCol_TableBorderStrong, &Palette::line},
    {ImGuiCol_TableBorderLight, &Palette::line},
    {ImGuiCol_TextSelectedBg, &Palette::tint},
    {ImGuiCol_NavHighlight, &Palette::accent},
    {ImGuiCol_DragDropTarget, &Palette::accent},
};

constexpr render::Colour nothing{0, 0, 0, 0};

}  // namespace

const Palette& palette_of(view::Theme theme) {
  switch (theme) {
    case view::Theme::dark:
      return dark_palette;
    case view::Theme::print:
      return print_palette;
    case view::Theme::light:
      break;
  }
  return light_palette;
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
  for (const auto& [part, colour] : roles) style.Colors[part] = mixed(colours.*colour);
  for (const ImGuiCol part : {ImGuiCol_ScrollbarBg, ImGuiCol_BorderShadow, ImGuiCol_TableRowBg,
                              ImGuiCol_TableRowBgAlt, ImGuiCol_ChildBg})
    style.Colors[part] = mixed(nothing);
  return style;
}

}  // namespace talus::gui
