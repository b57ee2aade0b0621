#pragma once
/// A plot: axes with round ticks, curves, a line at the frame shown, values under the mouse.

#include <optional>

#include "gui/widgets.h"

namespace talus {

/// Draws a plot into a box of that size at the cursor. `mark`: x of the frame shown. Noted as "plot NAME".
void draw_plot(Gui& gui, const Plot& plot, const ImVec2& size, std::optional<double> mark);

}  // namespace talus
