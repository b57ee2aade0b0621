#pragma once
/// What keys and widgets do with the second view.

#include "gui/widgets.h"

namespace talus {

/// Shows or hides it; another map where it would be the first view again.
void toggle_beside(Gui& gui);
/// Shows what has changed from the frame shown on.
void show_change_since_here(Gui& gui);
/// Shows the run that the panel names; what stands in the way becomes the message.
void show_run_beside(Gui& gui);
/// "θ": by what runs are linked.
std::string clock_name(PlotAxis clock);

}  // namespace talus
