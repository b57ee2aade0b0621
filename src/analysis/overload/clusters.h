#pragma once
/// Clusters of grains and their sizes.

#include <vector>

#include "analysis/overload/links.h"
#include "core/types.h"

namespace talus::analysis {

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

}  // namespace talus::analysis
