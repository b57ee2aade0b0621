#pragma once
/// Persistence diagrams of the contact network (Kramar et al. 2014): components and loops of the graph that
/// grows as a force threshold is lowered, and their lifetimes.

#include <span>
#include <vector>

#include "analysis/record.h"
#include "core/bed_frame.h"

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

/// Returns the sliced Wasserstein distance of two diagrams, in the unit of their thresholds (Carriere, Cuturi
/// and Oudot 2017). To each diagram, the points of the other are added, projected onto the diagonal. Both are
/// projected onto lines in sixteen directions, and the distances between the sorted projections are summed.
/// The result is the mean over the directions.
double sliced_distance(std::span<const Lifetime> one, std::span<const Lifetime> other);

/// Sets members of a record that are defined in the table of quantities. `diagram` and `thresholds` are in
/// units of the mean normal force of all contacts.
void measure_topology(const PersistenceDiagram& diagram, Index free_count, std::span<const double> thresholds,
                      FrameRecord& record);

/// Sets the change of the network from frame to frame. `diagrams` are those of the frames, in units of their
/// mean normal forces.
void measure_network_changes(const std::vector<PersistenceDiagram>& diagrams, Index free_count,
                             std::vector<FrameRecord>& frames);

}  // namespace talus::analysis
