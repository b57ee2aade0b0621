#pragma once
/// Percolation of clusters of grains through the bed.

#include <vector>

#include "analysis/overload/clusters.h"
#include "analysis/overload/links.h"
#include "core/bed_frame.h"

namespace talus::analysis {

/// Free grains at the edges of the bed, from which clusters may span it. D is the mean diameter.
struct BedEdges {
  std::vector<bool> floor;  ///< force-carrying contact with the floor, or centre less than D above y = 0
  /// Top less than D below the highest top in the same column of the bed, about D wide.
  std::vector<bool> surface;
  std::vector<bool> left, right;  ///< edge less than D away from a side wall; none in a periodic bed
};
/// Finds the free grains at each edge of the bed.
BedEdges bed_edges(const BedFrame& bed);

/// The largest cluster (the smallest label) that spans the bed; -1 if none does.
struct SpanningClusters {
  Index floor_to_surface = -1;
  Index across = -1;  ///< wall to wall, or linked to itself through the periodic edge
};
/// Finds the largest cluster that spans from floor to surface and the largest that spans along the bed.
SpanningClusters find_spanning(const Clusters& clusters, const BedEdges& edges);

/// Directed paths through the grains of a set.
struct DirectedPaths {
  double height = 0.0;  ///< largest rise in y from the first to the last centre of a path, m
  bool spans = false;   ///< whether a path leads from a floor grain to a surface grain
};

/// Finds the paths of links between grains with `in_set` in which every step, from centre to centre, is
/// within `spread` (rad) of `direction` (rad, relative to the bed). Every step must rise: direction - spread
/// > 0 and direction + spread < pi. The paper expects "directed" percolation along the preferred directions
/// of its contacts (section V B), which rise at 60 and 120 deg.
DirectedPaths directed_paths(const BedFrame& bed, const std::vector<bool>& in_set,
                             const std::vector<Link>& links, const BedEdges& edges, double direction,
                             double spread);

}  // namespace talus::analysis
