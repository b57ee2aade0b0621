#pragma once
/// Whether clusters of grains span the bed.

#include <vector>

#include "analysis/overload/clusters.h"
#include "analysis/overload/links.h"
#include "core/bed_frame.h"

namespace talus::analysis {

/// Free grains at which clusters may begin and end. D is the mean diameter.
struct BedEdges {
  std::vector<bool> floor;        ///< in force contact with a floor grain, or centre less than D above y = 0
  std::vector<bool> surface;      ///< top less than D below the free surface: the top of the highest grain
                                  ///< that reaches into the same column of the bed, about D wide
  std::vector<bool> left, right;  ///< edge less than D away from a side wall; none in a periodic bed
};
BedEdges bed_edges(const BedFrame& bed);

/// The largest cluster (the smallest label) that spans; -1 where none does.
struct Spanning {
  Index floor_to_surface = -1;
  Index across = -1;  ///< from wall to wall, or linked to itself through the periodic edge
};
Spanning find_spanning(const Clusters& clusters, const BedEdges& edges);

/// Paths through the grains of a set that advance with every step.
struct DirectedPaths {
  double height = 0.0;  ///< m, the largest rise in y from the first to the last centre of a path
  bool spans = false;   ///< whether a path leads from a floor grain to a surface grain
};

/// Paths of links between grains with `in_set` in which every step, from centre to centre, is within `spread`
/// (rad) of `direction` (rad, to the bed), both so that each step rises: direction - spread > 0 and
/// direction + spread < pi. The paper's "directed" percolation (section V C) is at 60 and 120 deg.
DirectedPaths directed_paths(const BedFrame& bed, const std::vector<bool>& in_set,
                             const std::vector<Link>& links, const BedEdges& edges, double direction,
                             double spread);

}  // namespace talus::analysis
