#pragma once
/// Plots of the window as JSON, from which the Python package draws figures.

#include <string>

#include "app/json.h"
#include "view/plots.h"
#include "view/view_state.h"

namespace talus::app {

/// Returns the plot as displayed, with its zoom and scale, as python/talus/figures/plots.py reads it. `run`:
/// path of the run, empty if it is in no file.
Json plot_json(const view::Plot& plot, const view::PlotOptions& options, const view::PlotMarks& marks,
               const std::string& run);

}  // namespace talus::app
