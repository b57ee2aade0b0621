#pragma once
/// Helpers of the panels: named widgets, numbers and texts.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gui/font.h"
#include "gui/gui.h"
#include "gui/imgui_versions.h"
#include "gui/theme.h"

namespace talus::gui {

/// Data that all panels share during one picture.
struct Gui {
  view::ViewModel& model;
  const DrawMap& draw_map;
  std::vector<WidgetPlace>& places;
  GuiRequests& requests;
  const Palette& colours;
  float em = 16.0f;         ///< text height, px
  std::string panel_asked;  ///< panel requested by a key
};

/// Records the place of the last widget.
void note_place(Gui& gui, std::string name);
void note_place(Gui& gui, std::string name, const ImVec2& low, const ImVec2& high);

/// Widgets recorded under `name`; each returns whether the user has used it. Labels are rich texts: inside
/// buttons, to the right of checkboxes, and to the left of all others, where the widget fills the rest of the
/// row; without a label it has the requested width. `tip` is shown while the mouse is over the widget.
bool named_button(Gui& gui, const char* name, const char* label, const char* tip = nullptr);
bool named_checkbox(Gui& gui, const char* name, const char* label, bool& value, const char* tip = nullptr);
bool named_slider(Gui& gui, const char* name, const char* label, double& value, double low, double high,
                  const char* format, const char* tip = nullptr, bool logarithmic = false);
bool named_number(Gui& gui, const char* name, const char* label, double& value, const char* format,
                  const char* tip = nullptr);
bool named_number(Gui& gui, const char* name, const char* label, int& value, const char* tip = nullptr);
bool named_number(Gui& gui, const char* name, const char* label, std::int64_t& value,
                  const char* tip = nullptr);
bool named_text(Gui& gui, const char* name, const char* label, std::string& value, const char* tip = nullptr);
/// Draws a slider that shows `current` and returns a value only when it is released.
std::optional<double> named_slider_when_done(Gui& gui, const char* name, const char* label, double current,
                                             double low, double high, const char* format,
                                             const char* tip = nullptr);
/// Draws a choice among texts; changes `chosen`.
bool named_choice(Gui& gui, const char* name, const char* label, const std::vector<std::string>& texts,
                  int& chosen);

/// Icons, drawn as shapes so that they are sharp at any size.
enum class Icon { play, pause, back, forward, first, last };

/// Draws an icon button, all of the same width, recorded under `name`; returns whether the user has used it.
bool icon_button(Gui& gui, const char* name, Icon icon, const char* tip);

/// Draws a line of text in the syntax of pictures: "_c" sets c as a subscript.
void rich_text(std::string_view text);
float rich_width(ImFont& font, float size, std::string_view text);
/// Returns the text in lines of at most that width (px), at least one; only a single piece (breakable_pieces)
/// may be wider.
std::vector<std::string> wrapped_text(std::string_view text, float width);
void add_rich_text(ImDrawList& list, const ImVec2& place, ImU32 colour, std::string_view text);

/// Continues in the same line if a width (px) is free there, else in the next line.
void same_line_if_fits(float width);

/// Draws "label   value" in two columns.
void fact(std::string_view label, const std::string& value);

}  // namespace talus::gui
