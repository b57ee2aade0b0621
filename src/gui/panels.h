#pragma once
/// The parts of the window. Each draws into the ImGui window that is open.

#include "gui/widgets.h"

namespace talus {

/// Playing and stepping: of a run that is computed, or of one that is replayed.
void draw_run_panel(Gui& gui);
/// Which map, and how.
void draw_map_panel(Gui& gui);
/// Commands to a run that is computed.
void draw_action_panel(Gui& gui);
/// Files: opening, saving, the command line that draws what is shown.
void draw_file_panel(Gui& gui);
/// What is known of the selected grain.
void draw_inspector(Gui& gui);
/// The curves.
void draw_plots(Gui& gui);
/// The map with its title and legend, the mouse on it.
void draw_map_area(Gui& gui);
/// How high the map is with its title and legend around a picture of `picture` px.
float map_area_height(float picture, float em);
/// All keys.
void draw_help(Gui& gui);

/// The legends of a view in a row; returns nothing, takes the width that there is.
void draw_legends(const FrameView& view);

/// Does what the keys pressed say.
void handle_keys(Gui& gui);

}  // namespace talus
