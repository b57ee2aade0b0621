#pragma once
/// Clusters of grains, their sizes, and the paths of overloaded grains through the bed.

#include <cstdint>
#include <vector>

#include "core/snapshot.h"
#include "core/types.h"

namespace talus::analysis {

// Disjoint sets (union-find) in a bed that may be periodic.

/// Disjoint sets of the elements 0 ... count - 1, with path halving. The root of a set is its smallest
/// element. The number of periods between each element and its root is known.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count);

  struct Place {
    Index root;
    Index periods;  ///< periods from the root to the element
  };
  /// Returns the root of the set of an element, and the periods between them.
  Place find(Index element);

  /// Joins the sets of a and b, where b is `shift` periods away from a. Returns false if they already belong
  /// to one set with a different number of periods between them: the set then closes on itself around the
  /// period.
  bool join(Index a, Index b, Index shift);

 private:
  std::vector<Index> parent_;
  std::vector<Index> periods_;  ///< periods from the parent
};

// Pairs of neighbouring grains, from which clusters are built.

/// Two free grains, a < b. Seen from a, grain b is at x_b + shift * period.
struct Link {
  Index a = 0, b = 0;
  std::int8_t shift = 0;
};

/// Returns the pairs of free grains in a contact that carries force. Floor grains and walls do not link.
std::vector<Link> force_links(const BedFrame& bed);

/// Returns the pairs of free grains whose centres are closer than `reach` times the sum of their radii:
/// nearest neighbours, in contact or not. With 1.1 the gap is less than a tenth of the mean diameter of the
/// pair. Each pair occurs once, with its nearest image, in the order of (a, b).
std::vector<Link> neighbour_links(const BedFrame& bed, double reach = 1.1);

/// Clusters in descending order of size; clusters of equal size are in the order of their smallest ids.
struct Clusters {
  std::vector<Index> label;  ///< cluster of each grain; -1 for a grain outside the set
  std::vector<Index> size;   ///< number of grains in each cluster
  /// x of each grain, m, unwrapped so that its cluster is in one piece; may lie outside the period.
  std::vector<double> unrolled;
  std::vector<bool> wraps;  ///< whether each cluster is linked to itself through the periodic edge
  Index members = 0;        ///< number of grains in the set

  Index count() const { return static_cast<Index>(size.size()); }
};

/// Finds the clusters of the grains with `in_set`, joined by the links between two of them. A grain without
/// links is a cluster by itself. `x`, in m, has at least as many entries as `in_set`; `period` is in m, 0 if
/// the bed is not periodic.
Clusters find_clusters(const std::vector<bool>& in_set, const std::vector<Link>& links,
                       const std::vector<double>& x, double period);

/// Return the size of the largest cluster in grains, and its share of the grains of the set. Without clusters
/// the size is 0 and the share is NaN.
Index largest_size(const Clusters& clusters);
double largest_share(const Clusters& clusters);

/// Returns the mean size in grains; NaN if there are no clusters.
double mean_size(const Clusters& clusters);

/// Returns the sum of s^2 over the sum of s for the cluster sizes s: the mean size of the cluster that
/// contains a grain of the set; NaN if there are no clusters. The second function leaves out the largest
/// cluster, as is usual in percolation theory.
double second_moment(const Clusters& clusters);
double second_moment_of_others(const Clusters& clusters);

/// Returns sqrt(2 sum of s^2 R^2 / sum of s^2), m, where R is the radius of gyration of a cluster of s grains
/// (Stauffer and Aharony, Introduction to Percolation Theory, Eq. 47). The sums are over clusters of at least
/// two grains that do not wrap around the period; NaN if there are none. `y` is in m.
double correlation_length(const Clusters& clusters, const std::vector<double>& y);

// Percolation of clusters of grains through the bed.

/// Free grains at the edges of the bed, from which clusters may span it. D is the mean diameter.
struct BedEdges {
  std::vector<bool> floor;  ///< force-carrying contact with the floor, or centre less than D above y = 0
  /// Top less than D below the highest top in the same column of the bed, about D wide.
  std::vector<bool> surface;
  std::vector<bool> left, right;  ///< edge less than D away from a side wall; none in a periodic bed
};
/// Finds the free grains at each edge of the bed.
BedEdges bed_edges(const BedFrame& bed);

/// The clusters that span the bed, and of each direction the largest (the smallest label); -1 if none does.
struct SpanningClusters {
  Index floor_to_surface = -1;
  Index across = -1;       ///< wall to wall, or linked to itself through the periodic edge
  std::vector<bool> each;  ///< whether a cluster spans the bed in either direction
};
/// Finds the clusters that span from floor to surface or along the bed.
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
