#pragma once
/// Figures of plots in the window.

#include <string>

#include "figures/figure.h"
#include "view/plots.h"
#include "view/view_state.h"

namespace talus::app {

/// Returns the plot as displayed, with its zoom, scale and the curves behind, as a figure named "plot-NAME"
/// and drawn by assets/figures/plot.gp. Curves with the same x values share a table. `run`: path of the run,
/// empty if it is in no file; `behind`: description of the curves behind.
figures::Figure plot_figure(const view::Plot& plot, const view::PlotOptions& options,
                            const view::PlotMarks& marks, const std::string& run, const std::string& behind);

}  // namespace talus::app
