#pragma once
/// Persistence diagrams of the contact network (Kramar et al. 2014): components and loops of the graph that
/// grows as a force threshold is lowered, and their lifetimes.

#include <span>
#include <vector>

#include "analysis/record.h"
#include "core/snapshot.h"

namespace talus::analysis {

/// Thresholds between which a feature exists as the threshold is lowered: birth >= death >= 0.
struct Lifetime {
  double birth = 0.0;
  double death = 0.0;
};

/// Diagram of the contacts between free grains whose force is at least the threshold. A component is born at
/// its largest force and dies when it meets an older one; if it meets none, it lasts to 0. A loop is born at
/// its smallest force and lasts to 0. Features that die at birth are left out.
struct PersistenceDiagram {
  std::vector<Lifetime> components, loops;
};

/// Computes the diagram, with thresholds in units of `force`, N/m. Exact, by union-find in descending order
/// of force.
PersistenceDiagram force_persistence(const BedFrame& bed, double force);

/// Betti numbers of a graph whose vertices are the grains touched by its edges.
struct GraphCount {
  Index components = 0;
  Index loops = 0;  ///< independent loops: edges - vertices + components
};

/// Returns the Betti numbers at a threshold, in the unit of the diagram.
GraphCount count_at(const PersistenceDiagram& diagram, double threshold);

/// Returns the sum of birth - death.
double total_persistence(std::span<const Lifetime> lifetimes);

/// Sets members of a record that are defined in the table of quantities. `diagram` and `thresholds` are in
/// units of the mean normal force of all contacts.
void measure_topology(const PersistenceDiagram& diagram, Index free_count, std::span<const double> thresholds,
                      FrameRecord& record);

/// Sets the change of the network from frame to frame: the sliced Wasserstein distance of two diagrams, for
/// each grain (Carriere, Cuturi and Oudot 2017). To each diagram, the points of the other are added,
/// projected onto the diagonal. Both are projected onto lines in sixteen directions, and the distances
/// between the sorted projections are summed; the result is the mean over the directions. `diagrams` are
/// those of the frames, in units of their mean normal forces.
void measure_network_changes(const std::vector<PersistenceDiagram>& diagrams, Index free_count,
                             std::vector<FrameRecord>& frames);

// Rigid clusters of a network of frictional contacts.

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
