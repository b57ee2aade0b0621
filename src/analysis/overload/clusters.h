#pragma once
/// Clusters of grains: which hang together, and how large they are.

#include <vector>

#include "analysis/overload/links.h"
#include "core/types.h"

namespace talus::analysis {

/// Clusters in the order of their sizes, the largest first; of equal ones the one with the smallest id first.
struct Clusters {
  std::vector<Index> label;      ///< cluster of each grain; -1 for one that is not in the set
  std::vector<Index> size;       ///< grains of each cluster
  std::vector<double> unrolled;  ///< x of each grain, m, in one piece with its cluster; may leave the period
  std::vector<bool> wraps;       ///< whether a cluster is linked to itself through the periodic edge
  Index members = 0;             ///< grains of the set

  Index count() const { return static_cast<Index>(size.size()); }
};

/// Clusters of the grains with `in_set`, joined by the links between two of them. A grain without links is a
/// cluster of its own. x in m, of at least as many grains as `in_set` has; `period` in m, 0 where the bed is
/// not periodic.
Clusters find_clusters(const std::vector<bool>& in_set, const std::vector<Link>& links,
                       const std::vector<double>& x, double period);

/// Grains of the largest cluster, 0 without any, and their share of the grains of the set, NaN without any.
Index largest_size(const Clusters& clusters);
double largest_share(const Clusters& clusters);

/// Mean size, in grains; NaN where there are no clusters.
double mean_size(const Clusters& clusters);

/// Sum of s^2 / sum of s over the sizes s: the mean size of the cluster that a grain of the set is in; NaN
/// where there are no clusters. "Of others": without the largest, as percolation theory has it.
double second_moment(const Clusters& clusters);
double second_moment_of_others(const Clusters& clusters);

/// sqrt(2 sum of s^2 R^2 / sum of s^2), R the radius of gyration of a cluster of s grains (Stauffer and
/// Aharony, Introduction to Percolation Theory, Eq. 47), m, over clusters of two grains and more that do not
/// wrap around; NaN without any. y in m.
double correlation_length(const Clusters& clusters, const std::vector<double>& y);

}  // namespace talus::analysis
