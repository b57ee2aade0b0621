#pragma once
/// Branches in the window: a replay that goes on, going back before a command, grains that are dragged.

#include "gui/select_tools.h"
#include "gui/widgets.h"

namespace talus {

/// The replay goes on from the frame shown.
void branch_here(Gui& gui);
/// The run goes back before its last command.
void go_back(Gui& gui);

/// The button of a replay.
void draw_branch_button(Gui& gui);
/// Of a branch: which run it has left, and the way back to that.
void draw_branch_origin(Gui& gui);
/// The button of a run that is computed.
void draw_back_button(Gui& gui);

/// From places on the map to pixels of the window, and back.
struct MapPlaces {
  std::function<ImVec2(double x, double y)> pixel;  ///< of a place in m, frame of the bed
  BedPlace bed;
};
/// Dragging a grain of a run that is computed and shown as it is now: instead of the lasso that begins on a
/// grain with ctrl, and without shift. `x`, `y`: where the mouse is, m; to be called where the map is the
/// last widget, before select_by_outline. True while the mouse belongs to a grain.
bool drag_grain(Gui& gui, double x, double y, const MapPlaces& places);

}  // namespace talus
