#pragma once
/// Rows of the table of quantities that describe rearrangements.

#include <vector>

#include "analysis/quantities.h"

namespace talus::analysis {

/// Returns the quantities of all events together, then those of each event.
std::vector<Quantity> event_quantities();

}  // namespace talus::analysis
