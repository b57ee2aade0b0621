#pragma once
/// The parts of the window. Each draws into the ImGui window that is open.

#include "gui/widgets.h"

namespace talus {

/// Playing and stepping, of a run that is computed or replayed.
void draw_run_panel(Gui& gui);
/// Which map is drawn, and how.
void draw_map_panel(Gui& gui);
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
/// The curves.
void draw_plots(Gui& gui);
/// The time line: the frames of the run and what happened in it.
void draw_time_line(Gui& gui);
/// The map with its title and legend, the mouse on it.
void draw_map_area(Gui& gui);
/// What the map tells of a grain under the mouse: its gamma on maps that show it.
std::string grain_text(const ViewModel& model, Index grain);
/// The height of the map with its title and legend around a picture of `picture` px.
float map_area_height(float picture, float em);
/// All keys.
void draw_help(Gui& gui);

/// The legends of a view in a row, in the available width.
void draw_legends(const FrameView& view);

/// Carries out what the pressed keys mean.
void handle_keys(Gui& gui);

}  // namespace talus
