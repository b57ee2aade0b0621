#pragma once
/// A plot of the window as a figure.

#include <string>

#include "figures/figure.h"
#include "view/plots.h"
#include "view/view_state.h"

namespace talus::app {

/// The plot as it is looked at, zoomed and logarithmic or not, with what stands behind its curves: named
/// "plot-NAME", drawn by assets/figures/plot.gp. Curves over the same places share a table. `run`: its path,
/// empty where it is in no file; `behind`: what the curves behind are of.
figures::Figure plot_figure(const view::Plot& plot, const view::PlotLook& look, const view::PlotMarks& marks,
                            const std::string& run, const std::string& behind);

}  // namespace talus::app
