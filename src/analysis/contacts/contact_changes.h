#pragma once
/// Contacts that one frame of a bed has and another has not.

#include <vector>

#include "core/snapshot.h"

namespace talus::analysis {

struct ContactChanges {
  std::vector<Index> gained;  ///< places in the contacts of the frame after, ascending
  std::vector<Index> lost;    ///< places in those of the frame before, ascending
};

/// Between two frames of the same grains, in any order of time. A contact is one that carries force, as
/// frames store them, and the same one where it is between the same two bodies; in a periodic bed between the
/// same two images of them, on whichever sides of the edge they are by now. Throws Error(internal) where the
/// frames have different numbers of grains.
ContactChanges contact_changes(const Frame& before, const Frame& after);

}  // namespace talus::analysis
