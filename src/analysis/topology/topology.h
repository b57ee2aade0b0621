#pragma once
/// The network of contacts as a graph that grows as a threshold of the force falls: its components and loops,
/// and how long each lasts (its persistence diagrams, Kramar and others 2014).

#include <span>
#include <vector>

#include "analysis/record.h"
#include "core/bed_frame.h"

namespace talus::analysis {

/// The thresholds between which something is there, the threshold falling: birth >= death >= 0.
struct Lifetime {
  double birth = 0.0;
  double death = 0.0;
};

/// Of the contacts between free grains that have at least the force of a threshold. A component is born with
/// the largest force in it, and dies where it meets an older one; one that meets none lasts down to 0. A loop
/// is born with the smallest force in it, and lasts down to 0. What dies at birth is left out.
struct PersistenceDiagram {
  std::vector<Lifetime> components, loops;
};

/// Thresholds in units of `force`, N/m. Exact, by union-find from the largest force down.
PersistenceDiagram force_persistence(const BedFrame& bed, double force);

/// Betti numbers of a graph whose vertices are the grains that its edges touch.
struct GraphCount {
  Index components = 0;
  Index loops = 0;  ///< independent ones: edges - vertices + components
};

/// At a threshold, in the unit of the diagram.
GraphCount count_at(const PersistenceDiagram& diagram, double threshold);

/// The sum of birth - death.
double total_persistence(std::span<const Lifetime> lifetimes);

/// Sliced Wasserstein distance of two diagrams, in the unit of their thresholds (Carriere, Cuturi and Oudot
/// 2017): to each the points of the other are added, projected onto the diagonal; both are projected onto
/// lines in sixteen directions, and the distances of these projections, taken in their order, are summed; the
/// mean over the directions.
double sliced_distance(std::span<const Lifetime> one, std::span<const Lifetime> other);

/// `diagram` and `thresholds` over the mean normal force of all contacts. Sets members of a record, which are
/// defined in the table of quantities.
void take_topology(const PersistenceDiagram& diagram, Index free_count, std::span<const double> thresholds,
                   FrameRecord& record);

/// What changes from frame to frame: `diagrams` are those of the frames, in units of their mean normal
/// forces. Sets a member of their records.
void take_network_changes(const std::vector<PersistenceDiagram>& diagrams, Index free_count,
                          std::vector<FrameRecord>& frames);

}  // namespace talus::analysis
