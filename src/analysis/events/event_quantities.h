#pragma once
/// The rows of the table of quantities that are about rearrangements.

#include <vector>

#include "analysis/quantities.h"

namespace talus::analysis {

/// What there is of them all, then what there is of each.
std::vector<Quantity> event_quantities();

}  // namespace talus::analysis
