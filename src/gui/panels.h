#pragma once
/// Parts of the window. Each is drawn into the current ImGui window.

#include "gui/widgets.h"

namespace talus::gui {

/// Draws the left column: the panels as foldable groups, including the inspector if it has no column.
void draw_column(Gui& gui, bool with_inspector);
/// Returns the group that a key unfolds; empty if there is none.
const char* group_of_key(ImWchar key);

/// Draws the controls of playback and stepping, for a live run or a replay.
void draw_run_panel(Gui& gui);
/// Returns "applied last, after step 120: friction 0.3": the last command of a live run.
std::string applied_text(std::span<const Command> commands);
/// Returns "frame 12 (0 to 81)": a frame of a run with `count` frames, counted from 0.
std::string frame_counter(std::size_t frame, std::size_t count);
/// Draws the choice of the map and its options.
void draw_map_panel(Gui& gui);
/// Draws the button of a replay that begins a branch.
void draw_branch_button(Gui& gui);
/// Draws the commands to a live run.
void draw_action_panel(Gui& gui);
/// Draws opening and saving of files, and the command line that draws the picture shown.
void draw_file_panel(Gui& gui);
/// Draws the properties of the selected grain.
void draw_inspector(Gui& gui);
/// Draws the properties of the selected contact, with its history; returns false if none is selected.
bool draw_contact_inspector(Gui& gui);
/// Returns the value of a curve nearest to x; NaN if there is none.
double value_near(const view::PlotSeries& series, double x);

/// Draws a plot of that size at the cursor, with the name "plot NAME". The wheel zooms along x, dragging
/// chooses a range and shows its statistics, and a double click enlarges the plot or restores it. Returns the
/// x that was clicked.
std::optional<double> draw_plot(Gui& gui, const view::Plot& plot, const ImVec2& size,
                                const view::PlotMarks& marks);

/// Draws the curves.
void draw_plots(Gui& gui);
/// Draws the time line: the frames of the run, and its events.
void draw_time_line(Gui& gui);
/// Draws the map with its title and legend, and handles the mouse on it.
void draw_map_area(Gui& gui);
/// Draws a picture of the bed, handles the mouse on it, and draws the arrow of gravity at its lower right.
void draw_map_pane(Gui& gui, const view::View& view, const ImVec2& room, bool with_gravity);
/// Draws the map and the second view, side by side or one above the other, whichever shows more. If there is
/// no room for two, draws nothing, reports this in the message, and returns false.
bool draw_pair(Gui& gui);
/// Returns the description of a grain under the mouse, as rich text: the value of the bar's quantity with its
/// unit, and gamma on maps of overloaded grains.
std::string grain_text(const view::View& view, Index grain);
/// Returns the height of the map with title and legend at a given width, around a picture of `picture` px.
float map_area_height(const render::FrameView& annotated, float width, float picture, float em);
/// Draws the list of keys.
void draw_help(Gui& gui);

/// Draws the legends of a view within a width (px), in as many rows as they need. If the view is `of_first`
/// map, the mouse changes the range of the first bar.
void draw_legends(Gui& gui, const render::FrameView& view, float width, bool of_first);
/// Returns the height of the legends, px.
float legend_height(const render::FrameView& view, float width);

/// Carries out the actions of the pressed keys.
void handle_keys(Gui& gui);

}  // namespace talus::gui
