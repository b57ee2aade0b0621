#pragma once
/// Contacts gained and lost between two frames of a bed.

#include <vector>

#include "core/snapshot.h"

namespace talus::analysis {

/// Contacts gained and lost from one frame to another.
struct ContactChanges {
  std::vector<Index> gained;  ///< indices into the contacts of the later frame, ascending
  std::vector<Index> lost;    ///< indices into those of the earlier frame, ascending
};

/// Compares the contacts of two frames of the same grains, in either order of time. Frames store contacts
/// that carry force. Contacts are the same if they connect the same two bodies and, in a periodic bed, the
/// same images, whichever side of the edge these have moved to. Throws Error(internal) if the frames have
/// different numbers of grains.
ContactChanges contact_changes(const Frame& before, const Frame& after);

}  // namespace talus::analysis
