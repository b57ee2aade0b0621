#pragma once
/// Small helpers of the panels: widgets that are remembered by name, numbers and texts.

#include <imgui.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gui/font.h"
#include "gui/gui.h"
#include "gui/theme.h"

namespace talus::gui {

/// What all panels work on during one picture.
struct Gui {
  view::ViewModel& model;
  const DrawMap& draw_map;
  std::vector<WidgetPlace>& places;
  GuiRequests& requests;
  const Palette& colours;
  float em = 16.0f;         ///< height of the text, px
  std::string panel_asked;  ///< a panel that a key has asked for
};

/// Remembers the place of the last widget.
void note_place(Gui& gui, std::string name);
void note_place(Gui& gui, std::string name, const ImVec2& low, const ImVec2& high);

/// Widgets that are remembered under `name`; true if the user has used them. Labels are rich texts: of
/// buttons inside, of checkboxes on the right, of all others on the left, where the widget takes the rest of
/// the row; without a label it is as wide as asked for. `tip` is shown when the mouse is over the widget.
bool named_button(Gui& gui, const char* name, const char* label, const char* tip = nullptr);
bool named_checkbox(Gui& gui, const char* name, const char* label, bool& value, const char* tip = nullptr);
bool named_slider(Gui& gui, const char* name, const char* label, double& value, double low, double high,
                  const char* format, const char* tip = nullptr, bool logarithmic = false);
bool named_number(Gui& gui, const char* name, const char* label, double& value, const char* format,
                  const char* tip = nullptr);
bool named_number(Gui& gui, const char* name, const char* label, int& value, const char* tip = nullptr);
bool named_text(Gui& gui, const char* name, const char* label, std::string& value, const char* tip = nullptr);
/// A slider that shows `current`, and returns a value only when it is released.
std::optional<double> named_slider_when_done(Gui& gui, const char* name, const char* label, double current,
                                             double low, double high, const char* format,
                                             const char* tip = nullptr);
/// A choice among texts; `chosen` is changed.
bool named_choice(Gui& gui, const char* name, const char* label, const std::vector<std::string>& texts,
                  int& chosen);

/// Signs that say more than a word: drawn as shapes, so that they are sharp at any size.
enum class Icon { play, pause, back, forward, first, last };

/// A button as wide as every other of these, remembered under `name`; true if the user has used it.
bool icon_button(Gui& gui, const char* name, Icon icon, const char* tip);

/// A line of text in the syntax of pictures: "_c" sets c as a subscript.
void rich_text(std::string_view text);
float rich_width(const ImFont& font, float size, std::string_view text);
/// In lines of at most that width, px, at least one; only a single piece (breakable_pieces) may be wider.
std::vector<std::string> wrapped_text(std::string_view text, float width);
void add_rich_text(ImDrawList& list, const ImVec2& place, ImU32 colour, std::string_view text);

/// What follows stands beside the last widget if a width, px, is free there, else in the next line.
void same_line_if_fits(float width);

/// "label   value" in two columns.
void fact(std::string_view label, const std::string& value);

}  // namespace talus::gui
