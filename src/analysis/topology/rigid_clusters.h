#pragma once
/// Which bodies a network of frictional contacts holds rigidly together.

#include <span>
#include <vector>

#include "analysis/record.h"
#include "core/bed_frame.h"

namespace talus::analysis {

/// Constraints between two bodies: 2 of a contact that sticks (a pin), 1 of one that slides (a bar).
struct Bond {
  Index a = 0, b = 0;
  int constraints = 0;
};

/// Sets of bodies that can only move as one. A body is in one of them only: each has three motions in the
/// plane, so what is rigid with it is rigid with each other.
struct RigidClusters {
  std::vector<Index> label;  ///< of each body: the first body of its cluster, itself where it is alone
  Index independent = 0;     ///< constraints that no others imply: the rank of the constraint matrix
  Index redundant = 0;       ///< those that others imply
};

/// By the double-bond pebble game of Henkes, Quint, Fily and Schwarz (Phys. Rev. Lett. 116, 028001, 2016),
/// the (3,3)-game of Lee and Streinu (Discrete Math. 308, 2008), for bodies 0 ... bodies - 1. It is exact for
/// pins and bars in general position (Tay 1984). The result does not depend on the order of the bonds.
RigidClusters find_rigid_clusters(Index bodies, std::span<const Bond> bonds);

/// The contacts of a bed with force as bonds between its free grains and, with the number after them, floor
/// and walls as one body.
std::vector<Bond> bonds_of(const BedFrame& bed);

/// Sets members of a record, which are defined in the table of quantities.
void take_rigid_clusters(const BedFrame& bed, FrameRecord& record);

}  // namespace talus::analysis
