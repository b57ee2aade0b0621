#pragma once
/// The rearrangements of a run as text.

#include <cstddef>
#include <string>

#include "runs/run_view.h"

namespace talus::app {

/// What the distributions say, in lines: count, sizes, waiting angles, share that dilates; and why where
/// there is no number.
std::string event_summary(const runs::RunView& run);

/// A table of the events, lengths in mean diameters, angles in degrees, energies in m g D; and the summary.
/// `largest`: so many events by their energy, in the order of the run; 0 for all.
std::string events_text(const runs::RunView& run, std::size_t largest);

/// Numbers of the run, and its events, under the names of the table of quantities; SI units, radians.
std::string events_json(const runs::RunView& run);

/// A line for each event, with the columns of the table of quantities; SI units, radians, empty where there
/// is no value. The line of their titles, with units, is the same for all runs.
std::string events_csv(const runs::RunView& run, bool titles);

}  // namespace talus::app
