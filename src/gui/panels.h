#pragma once
/// Named widgets and texts (widgets.cpp), the parts of the window that are made of them, each drawn into the
/// current ImGui window, and the actions of keys, buttons and the mouse. Each action has a visible effect, or
/// the line at the bottom says what it did or why it could not.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gui/gui.h"
#include "gui/imgui_versions.h"
#include "gui/theme.h"
#include "render/layout.h"

namespace talus::gui {

/// Data that all panels share during one picture.
struct Gui {
  view::ViewModel& model;
  view::ViewState& state;  ///< state of the model
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

/// Draws a button with simple shapes of the font, all of the same width, recorded under `name`; returns
/// whether the user has used it.
bool icon_button(Gui& gui, const char* name, const char* icon, const char* tip);
inline constexpr const char *play_icon = "▶", *pause_icon = "▮▮";

/// Draws a line of text in the syntax of pictures: "_c" sets c as a subscript.
void rich_text(std::string_view text);
float rich_width(std::string_view text);
/// Returns the text in lines of at most that width (px), at least one; a piece may be wider.
std::vector<std::string> wrapped_text(std::string_view text, float width);
void add_rich_text(ImDrawList& list, const ImVec2& place, ImU32 colour, std::string_view text);

/// Continues in the same line if a width (px) is free there, else in the next line.
void same_line_if_fits(float width);

/// Draws "label   value" in two columns.
void fact(std::string_view label, const std::string& value);

/// Returns the group that a key unfolds; empty if there is none.
const char* group_of_key(ImWchar key);

// Panels, in the column and below the map.
void draw_run_panel(Gui& gui);     ///< playback and stepping of a live run or a replay
void draw_map_panel(Gui& gui);     ///< choice of the map and its options
void draw_action_panel(Gui& gui);  ///< commands to a live run
void draw_file_panel(Gui& gui);    ///< opening and saving, and the command line that draws the picture shown
void draw_inspector(Gui& gui);     ///< properties of the selected grain or contact
void draw_plots(Gui& gui);
void draw_time_line(Gui& gui);  ///< frames of the run, and its events
void draw_map_area(Gui& gui);   ///< map with its title and legend, and the mouse on it
void draw_help(Gui& gui);       ///< list of keys

/// Returns "frame 12 (0 to 81)": a frame of a run with `count` frames, counted from 0.
std::string frame_counter(std::size_t frame, std::size_t count);
/// Returns the value of a curve nearest to x; NaN if there is none.
double value_near(const view::PlotSeries& series, double x);
/// Returns the description of a grain under the mouse, as rich text: the value of the bar's quantity with its
/// unit, and gamma on maps of overloaded grains.
std::string grain_text(const view::View& view, Index grain);

/// Draws a plot of that size at the cursor, with the name "plot NAME". The wheel zooms along x, dragging
/// chooses a range and shows its statistics, and a double click enlarges the plot or restores it. Returns the
/// x that was clicked.
std::optional<double> draw_plot(Gui& gui, const view::Plot& plot, const ImVec2& size,
                                const view::PlotMarks& marks);

/// Returns the height of the map with title and legend at a given width, around a picture of `picture` px.
float map_area_height(const render::FrameView& annotated, float width, float picture, float em);
/// Draws the legends of a view within a width (px), in as many rows as they need. If the view is `of_first`
/// map, the mouse changes the range of the first bar.
void draw_legends(Gui& gui, const render::FrameView& view, float width, bool of_first);
/// Returns the height of the legends, px.
float legend_height(const render::FrameView& view, float width);

/// Carries out the actions of the pressed keys.
void handle_keys(Gui& gui);
/// Writes the line at the bottom.
void show_message(Gui& gui, std::string text);

// Picture.

/// Goes to a landmark of the run.
void go_to_landmark(Gui& gui, view::Landmark landmark);
/// Zooms by a factor about a place (m), which keeps its position in the picture.
void zoom_about(Gui& gui, double factor, double x, double y);
/// Moves the picture (m), and stops following a grain.
void move_picture(Gui& gui, double dx, double dy);
void show_whole_bed(Gui& gui);
/// Starts or stops keeping the selected grain, with its surroundings, in the middle of the picture.
void toggle_following(Gui& gui);

// Run.

void toggle_playing(Gui& gui);
/// Advances a live run by `count` steps, or a replay by `count` frames, which may be negative. In a live run,
/// stepping back goes through the frames recorded so far; stepping beyond the last follows the run again.
void advance(Gui& gui, int count);
/// Computes until the bed has come to rest and the tilt begins.
void deposit(Gui& gui);
/// Computes until the tilt entered by the user.
void run_to_tilt(Gui& gui);
/// Suggests a later tilt to run to, once the run has passed the suggested one.
void offer_tilt_ahead(view::ViewModel& model);
/// Sends a command to the run; the reason of a rejection becomes the message.
void send(Gui& gui, const Command& command);
/// Restarts the run of a scenario with the given seed.
void reset(Gui& gui);
/// Saves a live run: by a checkpoint if it is recorded; otherwise by writing it from its beginning to the
/// file named in the panel of files, in which it is then recorded.
void save_state(Gui& gui);
void push_selected(Gui& gui);
void drop_here(Gui& gui);
/// Continues the replay from the frame shown.
void branch_here(Gui& gui);
/// Returns the run to the state before its last command.
void go_back(Gui& gui);

/// Placement of the map in the window: converts points (m, frame of the bed) to pixels and back.
struct ShownMap {
  ImVec2 corner;
  render::Camera camera;

  render::Point bed_place(const ImVec2& px) const;
  ImVec2 pixel(double x, double y) const;
};

/// Handles selection with modifier keys. With shift, a click adds the grain to the selection or removes it,
/// and dragging draws a box. With ctrl, or both, a click selects the nearest contact, and dragging draws a
/// lasso. The map must be the last item. Returns whether the mouse is used.
bool select_by_outline(Gui& gui, const ShownMap& map);

/// Selects at a click without modifiers: the grain there, or a nearby contact if the map shows them (m).
void select_clicked(Gui& gui, double x, double y);

/// Handles dragging a grain with ctrl and without shift, in a live run that is followed; it replaces the
/// lasso if the drag begins on a grain. `x`, `y`: position of the mouse, m. The map must be the last widget;
/// call before select_by_outline. Returns whether the mouse holds a grain.
bool drag_grain(Gui& gui, double x, double y, const ShownMap& map);

}  // namespace talus::gui
