#pragma once
/// Selecting with the mouse on the map.

#include <functional>

#include "gui/widgets.h"
#include "render/layout.h"

namespace talus {

constexpr float least_drag = 4.0f;  ///< px; less is a click

/// Where a place of the window is in the frame of the bed, m.
using BedPlace = std::function<Point(const ImVec2& px)>;

/// With shift: a click adds the grain to those that are selected, or takes it away, and dragging draws a box.
/// With ctrl, or both: a click selects the nearest contact, and dragging draws a lasso. To be called for the
/// map as the last item. Returns whether the mouse is used by it.
bool select_by_outline(Gui& gui, const BedPlace& bed_place);

/// A click on the map without these: the grain there, or the contact where the map shows contacts and one is
/// near (m, frame of the bed).
void select_clicked(Gui& gui, double x, double y);

}  // namespace talus
