#pragma once
/// Rigid clusters of a network of frictional contacts.

#include <span>
#include <vector>

#include "analysis/record.h"
#include "core/bed_frame.h"

namespace talus::analysis {

/// Constraints between two bodies: 2 for a sticking contact (a pin), 1 for a sliding contact (a bar).
struct Bond {
  Index a = 0, b = 0;
  int constraints = 0;
};

/// Sets of bodies that can only move as one. Each body belongs to exactly one set: it has three degrees of
/// freedom in the plane, so any two sets that share it are rigid together.
struct RigidClusters {
  std::vector<Index> label;  ///< first body in the cluster of each body; the body itself if it is alone
  Index independent = 0;     ///< independent constraints, the rank of the constraint matrix
  Index redundant = 0;       ///< constraints implied by others
};

/// Finds the clusters by the double-bond pebble game of Henkes, Quint, Fily and Schwarz (Phys. Rev. Lett.
/// 116, 028001, 2016), the (3,3)-game of Lee and Streinu (Discrete Math. 308, 2008), for bodies 0 ... bodies
/// - 1. It is exact for pins and bars in generic position (Tay 1984). The result does not depend on the order
/// of the bonds.
RigidClusters find_rigid_clusters(Index bodies, std::span<const Bond> bonds);

/// Returns the force-carrying contacts of a bed as bonds between its free grains and one further body,
/// numbered after them, for floor and walls together.
std::vector<Bond> bonds_of(const BedFrame& bed);

/// Sets members of a record that are defined in the table of quantities.
void measure_rigid_clusters(const BedFrame& bed, FrameRecord& record);

}  // namespace talus::analysis
