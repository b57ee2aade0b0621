#pragma once
/// The parts of the window. Each draws into the ImGui window that is open.

#include "gui/widgets.h"

namespace talus::gui {

/// The column on the left: the panels as groups that are folded and unfolded; the inspector among them where
/// it has no column of its own.
void draw_column(Gui& gui, bool with_inspector);
/// The group that a key unfolds; empty where it is for none.
const char* group_of_key(ImWchar key);

/// Playing and stepping, of a run that is computed or replayed.
void draw_run_panel(Gui& gui);
/// "applied last, after step 120: friction 0.3": what was done last to a run that is computed.
std::string applied_text(std::span<const Command> commands);
/// "frame 12 (0 to 81)": a frame of a run with so many of them, counted from 0 as everywhere.
std::string frame_counter(std::size_t frame, std::size_t count);
/// Which map is drawn, and how.
void draw_map_panel(Gui& gui);
/// The button of a replay that begins a branch.
void draw_branch_button(Gui& gui);
/// Commands to a run that is computed.
void draw_action_panel(Gui& gui);
/// Selecting by a condition; what is selected as a table.
void draw_select_panel(Gui& gui);
/// Files: opening, saving, the command line that draws what is shown.
void draw_file_panel(Gui& gui);
/// Everything known of the selected grain.
void draw_inspector(Gui& gui);
/// The same of the selected contact, with its history; false where none is selected.
bool draw_contact_inspector(Gui& gui);
/// The value of a curve nearest to x; NaN where it has none.
double value_near(const view::PlotSeries& series, double x);

/// Draws a plot into a box of that size at the cursor. Noted as "plot NAME". The wheel zooms along x,
/// dragging chooses a range whose statistics are told, a double click enlarges the plot or ends that. Returns
/// the x that was clicked.
std::optional<double> draw_plot(Gui& gui, const view::Plot& plot, const ImVec2& size,
                                const view::PlotMarks& marks);

/// The curves.
void draw_plots(Gui& gui);
/// The time line: the frames of the run and what happened in it.
void draw_time_line(Gui& gui);
/// The map with its title and legend, the mouse on it.
void draw_map_area(Gui& gui);
/// A picture of the bed with the mouse on it, and the arrow of gravity on the right below it.
void draw_map_pane(Gui& gui, const view::View& view, const ImVec2& room, bool with_gravity);
/// The map and the second view, beside each other or one above the other, whichever shows more. False where
/// there is no room for two, which the message says; nothing is drawn then.
bool draw_pair(Gui& gui);
/// What the map tells of a grain under the mouse, as rich text: what its bar measures, with the unit, and
/// gamma on maps of overloaded grains.
std::string grain_text(const view::View& view, Index grain);
/// The height of the map with its title and legend in a width, around a picture of `picture` px.
float map_area_height(const render::FrameView& annotated, float width, float picture, float em);
/// All keys.
void draw_help(Gui& gui);

/// The legends of a view in a width, px, in as many rows as they need.
/// The range of the first bar is chosen with the mouse if the view is `of_first` map.
void draw_legends(Gui& gui, const render::FrameView& view, float width, bool of_first);
/// How high they are then, px.
float legend_height(const render::FrameView& view, float width);

/// Carries out what the pressed keys mean.
void handle_keys(Gui& gui);

}  // namespace talus::gui
