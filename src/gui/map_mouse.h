#pragma once
/// Mouse on the map: selecting and dragging grains.

#include "gui/widgets.h"
#include "render/layout.h"

namespace talus::gui {

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

/// Selects at a click without modifiers: the grain there, or a nearby contact if the map shows contacts (m,
/// frame of the bed).
void select_clicked(Gui& gui, double x, double y);

/// Handles dragging a grain with ctrl and without shift, in a live run that is followed; it replaces the
/// lasso if the drag begins on a grain. `x`, `y`: position of the mouse, m. The map must be the last widget;
/// call before select_by_outline. Returns whether the mouse holds a grain.
bool drag_grain(Gui& gui, double x, double y, const ShownMap& map);

}  // namespace talus::gui
