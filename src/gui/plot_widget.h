#pragma once
/// A plot: axes with round ticks, curves, a line at the frame shown, values under the mouse.

#include <optional>

#include "gui/widgets.h"

namespace talus {

/// The value of a curve nearest to x; NaN where it has none.
double value_near(const PlotSeries& series, double x);

/// Draws a plot into a box of that size at the cursor. Noted as "plot NAME". The wheel zooms along x,
/// dragging chooses a range whose statistics are told, a double click enlarges the plot or ends that. Returns
/// the x that was clicked.
std::optional<double> draw_plot(Gui& gui, const Plot& plot, const ImVec2& size, const PlotMarks& marks);

}  // namespace talus
