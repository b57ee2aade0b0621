#pragma once
/// Quantities over tilt, and the tilts of events, as JSON.

#include <string>

#include "exports/page/page_run.h"

namespace talus::exports {

/// Returns {"rows": tilts of the observables, deg; "frames": tilts of all frames of the tilt, deg;
/// "quantities": all known scalar quantities of a frame, in the order of the table, each with its title,
/// definition and curves: one, or one for each threshold}. The curve of a quantity that the run also records
/// uses the recorded values.
std::string curves_json(const PageRun& run);

/// Returns the events of the time line (view/timeline.h) between the frames of the page, each with its
/// position among them.
std::string events_json(const PageRun& run);

}  // namespace talus::exports
