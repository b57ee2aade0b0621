#pragma once
/// Quantities over the tilt, and what happened at which tilt, as JSON.

#include <string>

#include "exports/page/page_run.h"

namespace talus::exports {

/// {"rows": tilts of the observables, deg; "frames": tilts of all frames of the tilt, deg; "quantities": all
/// numbers of a frame that the analysis knows, in the order of the table, each with its title, definition and
/// curves: one, or one for each threshold}. Where a run records a quantity as well, its curve is that.
std::string curves_json(const PageRun& run);

/// The events of the time line (view/timeline.h) that lie between the frames of the page, each with its
/// place among these.
std::string events_json(const PageRun& run);

}  // namespace talus::exports
