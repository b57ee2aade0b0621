#include "analysis/overload/clusters.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "analysis/cells.h"
#include "analysis/free_grains.h"
#include "core/trigonometry.h"

namespace talus::analysis {

DisjointSets::DisjointSets(std::size_t count) : parent_(count), periods_(count, 0) {
  std::iota(parent_.begin(), parent_.end(), 0);
}

DisjointSets::Place DisjointSets::find(Index element) {
  Index periods = 0;
  while (parent_[element] != element) {
    const Index up = parent_[element];
    periods_[element] += periods_[up];  // 0 if `up` is a root
    parent_[element] = parent_[up];
    periods += periods_[element];
    element = parent_[element];
  }
  return {element, periods};
}

bool DisjointSets::join(Index a, Index b, Index shift) {
  const Place place_a = find(a);
  const Place place_b = find(b);
  if (place_a.root == place_b.root) return place_b.periods == place_a.periods + shift;
  const Index between = place_a.periods + shift - place_b.periods;  // from the root of a to the root of b
  const Index high = std::max(place_a.root, place_b.root);
  parent_[high] = std::min(place_a.root, place_b.root);
  periods_[high] = high == place_b.root ? between : -between;
  return true;
}

std::vector<Link> force_links(const BedFrame& bed) {
  const FrameContacts& contacts = bed.frame.contacts;
  std::vector<Link> links;
  for (Index c = 0; c < contacts.count(); ++c)
    if (contacts.a[c] < bed.statics.free_count && contacts.b[c] < bed.statics.free_count)
      links.push_back({contacts.a[c], contacts.b[c], contacts.shift[c]});
  return links;
}

std::vector<Link> neighbour_links(const BedFrame& bed, double reach) {
  std::vector<Link> links;
  if (bed.statics.free_count == 0) return links;
  const double period = period_of(bed.statics);
  const std::vector<double> x = free_grain_values(bed.frame.x, bed.statics);
  const std::vector<double> y = free_grain_values(bed.frame.y, bed.statics);
  const double largest = *std::max_element(bed.statics.radius.begin(), bed.statics.radius.end());
  const Cells cells = sort_into_cells(x, y, 2.0 * largest * reach, period);
  for (Index a = 0; a < bed.statics.free_count; ++a) {
    const auto first = static_cast<std::ptrdiff_t>(links.size());
    const auto link_to = [&](Index b) {
      if (b <= a) return;
      const Index shift = nearest_image(x[b] - x[a], period);
      const double dx = x[b] - x[a] + shift * period;
      const double dy = y[b] - y[a];
      const double limit = reach * (bed.statics.radius[a] + bed.statics.radius[b]);
      if (dx * dx + dy * dy < limit * limit) links.push_back({a, b, static_cast<std::int8_t>(shift)});
    };
    for (Index ring = 0; ring <= 1; ++ring)
      visit_ring(cells, column_of(cells, x[a]), row_of(cells, y[a]), ring, link_to);
    std::sort(links.begin() + first, links.end(),
              [](const Link& one, const Link& other) { return one.b < other.b; });
  }
  return links;
}

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

namespace {

/// The bed divided along x into equal columns, about a mean diameter wide.
struct BedColumns {
  Index count = 1;
  double width = 0.0;  ///< m
  bool periodic = false;

  /// Returns the column at x. In a bed with ends, positions beyond them belong to the outermost column.
  Index at(double x) const {
    const auto column = static_cast<Index>(std::floor(x / width));
    return periodic ? ((column % count) + count) % count : std::clamp<Index>(column, 0, count - 1);
  }
};

BedColumns make_columns(const RunStatics& statics) {
  const auto count = static_cast<Index>(std::max(1.0, std::round(statics.length / statics.mean_diameter)));
  return {count, statics.length / count, statics.periodic};
}

/// Returns the height of the highest top of a grain in each column, m.
std::vector<double> highest_tops(const BedFrame& bed, const BedColumns& columns) {
  std::vector<double> top(columns.count, 0.0);
  for (Index i = 0; i < bed.statics.free_count; ++i) {
    const double radius = bed.statics.radius[i];
    const Index first = columns.at(bed.frame.x[i] - radius);
    const Index last = columns.at(bed.frame.x[i] + radius);
    for (Index k = first;; k = (k + 1) % columns.count) {
      top[k] = std::max(top[k], bed.frame.y[i] + radius);
      if (k == last) break;
    }
  }
  return top;
}

/// Returns whether each cluster contains a grain with `edge`.
std::vector<bool> touching(const Clusters& clusters, const std::vector<bool>& edge) {
  std::vector<bool> touches(clusters.size.size(), false);
  for (std::size_t i = 0; i < clusters.label.size(); ++i)
    if (clusters.label[i] >= 0 && edge[i]) touches[clusters.label[i]] = true;
  return touches;
}

}  // namespace

BedEdges bed_edges(const BedFrame& bed) {
  const std::size_t count = bed.statics.free_count;
  const double d = bed.statics.mean_diameter;
  BedEdges edges;
  for (auto* edge : {&edges.floor, &edges.surface, &edges.left, &edges.right}) edge->assign(count, false);
  const BedColumns columns = make_columns(bed.statics);
  const std::vector<double> surface = highest_tops(bed, columns);
  for (std::size_t i = 0; i < count; ++i) {
    const double radius = bed.statics.radius[i];
    edges.floor[i] = bed.frame.y[i] < d;
    edges.surface[i] = bed.frame.y[i] + radius > surface[columns.at(bed.frame.x[i])] - d;
    edges.left[i] = !bed.statics.periodic && bed.frame.x[i] - radius < d;
    edges.right[i] = !bed.statics.periodic && bed.frame.x[i] + radius > bed.statics.length - d;
  }
  const FrameContacts& contacts = bed.frame.contacts;
  for (Index c = 0; c < contacts.count(); ++c)
    if (contacts.a[c] < bed.statics.free_count && contacts.b[c] >= bed.statics.free_count &&
        contacts.b[c] < bed.frame.grain_count())
      edges.floor[contacts.a[c]] = true;
  return edges;
}

SpanningClusters find_spanning(const Clusters& clusters, const BedEdges& edges) {
  const std::vector<bool> floor = touching(clusters, edges.floor);
  const std::vector<bool> surface = touching(clusters, edges.surface);
  const std::vector<bool> left = touching(clusters, edges.left);
  const std::vector<bool> right = touching(clusters, edges.right);
  SpanningClusters spanning;
  spanning.each.resize(clusters.size.size());
  for (Index k = clusters.count() - 1; k >= 0; --k) {
    const bool rises = floor[k] && surface[k], crosses = clusters.wraps[k] || (left[k] && right[k]);
    if (rises) spanning.floor_to_surface = k;
    if (crosses) spanning.across = k;
    spanning.each[k] = rises || crosses;
  }
  return spanning;
}

DirectedPaths directed_paths(const BedFrame& bed, const std::vector<bool>& in_set,
                             const std::vector<Link>& links, const BedEdges& edges, double direction,
                             double spread) {
  struct Step {
    Index from, to;
  };
  const double from_vertical = 0.5 * pi - direction;
  const Vec2 along = {sine(from_vertical), cosine(from_vertical)};
  const double least = cosine(spread);
  std::vector<Step> steps;
  for (const Link& link : links) {
    if (!in_set[link.a] || !in_set[link.b]) continue;
    const double dx = bed.frame.x[link.b] + link.shift * bed.statics.length - bed.frame.x[link.a];
    const double dy = bed.frame.y[link.b] - bed.frame.y[link.a];
    const double advance = dx * along.x + dy * along.y;
    if (std::fabs(advance) < least * std::sqrt(dx * dx + dy * dy)) continue;
    steps.push_back(advance > 0.0 ? Step{link.a, link.b} : Step{link.b, link.a});
  }
  // Every step rises, so in the order of starting heights all paths to a grain are known before a step leaves
  // it.
  std::sort(steps.begin(), steps.end(), [&](const Step& one, const Step& other) {
    return bed.frame.y[one.from] < bed.frame.y[other.from];
  });
  std::vector<double> lowest(bed.frame.y.begin(), bed.frame.y.begin() + bed.statics.free_count);
  std::vector<bool> from_floor = edges.floor;
  DirectedPaths paths;
  for (std::size_t i = 0; i < in_set.size(); ++i)
    paths.spans = paths.spans || (in_set[i] && edges.floor[i] && edges.surface[i]);
  for (const Step& step : steps) {
    lowest[step.to] = std::min(lowest[step.to], lowest[step.from]);
    if (from_floor[step.from]) from_floor[step.to] = true;
    paths.height = std::max(paths.height, bed.frame.y[step.to] - lowest[step.to]);
    paths.spans = paths.spans || (from_floor[step.to] && edges.surface[step.to]);
  }
  return paths;
}

}  // namespace talus::analysis
