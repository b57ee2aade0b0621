#pragma once
/// The mouse on the map: selecting, and dragging grains.

#include "gui/widgets.h"
#include "render/layout.h"

namespace talus::gui {

/// The map as it lies in the window: from places (m, frame of the bed) to pixels, and back.
struct ShownMap {
  ImVec2 corner;
  render::Camera camera;

  render::Point bed_place(const ImVec2& px) const;
  ImVec2 pixel(double x, double y) const;
};

/// With shift: a click adds the grain to those that are selected, or takes it away, and dragging draws a box.
/// With ctrl, or both: a click selects the nearest contact, and dragging draws a lasso. To be called for the
/// map as the last item. Returns whether the mouse is used by it.
bool select_by_outline(Gui& gui, const ShownMap& map);

/// A click on the map without these: the grain there, or the contact where the map shows contacts and one is
/// near (m, frame of the bed).
void select_clicked(Gui& gui, double x, double y);

/// Dragging a grain of a run that is computed and shown as it is now: instead of the lasso that begins on a
/// grain with ctrl, and without shift. `x`, `y`: where the mouse is, m; to be called where the map is the
/// last widget, before select_by_outline. True while the mouse belongs to a grain.
bool drag_grain(Gui& gui, double x, double y, const ShownMap& map);

}  // namespace talus::gui
