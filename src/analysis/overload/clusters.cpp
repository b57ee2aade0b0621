#include "analysis/overload/clusters.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "analysis/overload/disjoint_sets.h"

namespace talus::analysis {
namespace {

/// Sorts clusters by size. Clusters of equal size keep their order, that of their smallest ids.
void sort_by_size(Clusters& clusters) {
  const std::vector<Index> size = clusters.size;
  std::vector<Index> order(size.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Index i, Index j) { return size[i] > size[j]; });
  std::vector<Index> place(size.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    place[order[k]] = static_cast<Index>(k);
    clusters.size[k] = size[order[k]];
  }
  for (Index& label : clusters.label)
    if (label >= 0) label = place[label];
}

double second_moment_from(const Clusters& clusters, std::size_t first) {
  double sum = 0.0, squares = 0.0;
  for (std::size_t k = first; k < clusters.size.size(); ++k) {
    const double size = clusters.size[k];
    sum += size;
    squares += size * size;
  }
  return sum > 0.0 ? squares / sum : not_known;
}

/// Returns the squared radius of gyration of each cluster, m^2.
std::vector<double> squared_radii(const Clusters& clusters, const std::vector<double>& y) {
  const std::size_t count = clusters.size.size();
  std::vector<double> mean_x(count, 0.0), mean_y(count, 0.0), spread(count, 0.0);
  for (std::size_t i = 0; i < clusters.label.size(); ++i)
    if (const Index k = clusters.label[i]; k >= 0) {
      mean_x[k] += clusters.unrolled[i] / clusters.size[k];
      mean_y[k] += y[i] / clusters.size[k];
    }
  for (std::size_t i = 0; i < clusters.label.size(); ++i)
    if (const Index k = clusters.label[i]; k >= 0) {
      const double dx = clusters.unrolled[i] - mean_x[k];
      const double dy = y[i] - mean_y[k];
      spread[k] += (dx * dx + dy * dy) / clusters.size[k];
    }
  return spread;
}

}  // namespace

Clusters find_clusters(const std::vector<bool>& in_set, const std::vector<Link>& links,
                       const std::vector<double>& x, double period) {
  DisjointSets sets(in_set.size());
  std::vector<Index> going_around;  // one grain of each cluster that closes on itself around the period
  for (const Link& link : links)
    if (in_set[link.a] && in_set[link.b] && !sets.join(link.a, link.b, link.shift))
      going_around.push_back(link.a);

  Clusters clusters;
  clusters.label.assign(in_set.size(), -1);
  clusters.unrolled.assign(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(in_set.size()));
  for (std::size_t i = 0; i < in_set.size(); ++i) {
    if (!in_set[i]) continue;
    const auto [root, periods] = sets.find(static_cast<Index>(i));
    // The root is the smallest element of its set and is therefore visited first.
    if (root == static_cast<Index>(i)) {
      clusters.label[i] = clusters.count();
      clusters.size.push_back(0);
    }
    clusters.label[i] = clusters.label[root];
    clusters.unrolled[i] += period * periods;
    ++clusters.size[clusters.label[i]];
    ++clusters.members;
  }
  sort_by_size(clusters);
  clusters.wraps.assign(clusters.size.size(), false);
  for (Index grain : going_around) clusters.wraps[clusters.label[grain]] = true;
  return clusters;
}

Index largest_size(const Clusters& clusters) { return clusters.size.empty() ? 0 : clusters.size.front(); }
double largest_share(const Clusters& clusters) {
  return static_cast<double>(largest_size(clusters)) / clusters.members;
}
double mean_size(const Clusters& clusters) {
  return clusters.members > 0 ? static_cast<double>(clusters.members) / clusters.count() : not_known;
}
double second_moment(const Clusters& clusters) { return second_moment_from(clusters, 0); }
double second_moment_of_others(const Clusters& clusters) { return second_moment_from(clusters, 1); }

double correlation_length(const Clusters& clusters, const std::vector<double>& y) {
  const std::vector<double> spread = squared_radii(clusters, y);
  double moments = 0.0, weights = 0.0;
  for (std::size_t k = 0; k < spread.size(); ++k) {
    if (clusters.size[k] < 2 || clusters.wraps[k]) continue;
    const double weight = static_cast<double>(clusters.size[k]) * clusters.size[k];
    moments += weight * spread[k];
    weights += weight;
  }
  return weights > 0.0 ? std::sqrt(2.0 * moments / weights) : not_known;
}

}  // namespace talus::analysis
