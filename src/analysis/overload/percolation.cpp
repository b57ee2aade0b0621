#include "analysis/overload/percolation.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/trigonometry.h"

namespace talus::analysis {
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
  std::vector<double> top(static_cast<std::size_t>(columns.count), 0.0);
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
  const auto count = static_cast<std::size_t>(bed.statics.free_count);
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
  for (Index k = clusters.count() - 1; k >= 0; --k) {
    if (floor[k] && surface[k]) spanning.floor_to_surface = k;
    if (clusters.wraps[k] || (left[k] && right[k])) spanning.across = k;
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
