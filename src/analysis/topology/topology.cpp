#include "analysis/topology/topology.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <utility>

#include "analysis/overload/disjoint_sets.h"
#include "core/trigonometry.h"

namespace talus::analysis {
namespace {

constexpr std::size_t slices = 16;

/// Returns the contacts between free grains in descending order of normal force.
std::vector<Index> contacts_by_force(const BedFrame& bed) {
  const FrameContacts& contacts = bed.frame.contacts;
  std::vector<Index> order;
  for (Index c = 0; c < contacts.count(); ++c)
    if (contacts.a[c] < bed.statics.free_count && contacts.b[c] < bed.statics.free_count) order.push_back(c);
  std::ranges::stable_sort(order, std::ranges::greater(), [&](Index c) { return contacts.fn[c]; });
  return order;
}

/// The components of a graph that grows edge by edge, and their births.
class GrowingGraph {
 public:
  explicit GrowingGraph(Index vertices)
      : sets_(static_cast<std::size_t>(vertices)), birth_(static_cast<std::size_t>(vertices), not_known) {}

  /// Returns the root of the component of a vertex. A vertex that is not in the graph yet is born at `now`.
  Index component(Index vertex, double now) {
    const Index root = sets_.find(vertex).root;
    if (std::isnan(birth_[root])) birth_[root] = now;
    return root;
  }

  /// Merges the younger of two components into the older one and returns the birth of the younger.
  double merge(Index one, Index other) {
    const double younger = std::min(birth_[one], birth_[other]);
    const double older = std::max(birth_[one], birth_[other]);
    sets_.join(one, other, 0);
    birth_[sets_.find(one).root] = older;
    return younger;
  }

  /// Returns the births of the remaining components.
  std::vector<double> births() {
    std::vector<double> births;
    for (Index vertex = 0; vertex < static_cast<Index>(birth_.size()); ++vertex)
      if (!std::isnan(birth_[vertex]) && sets_.find(vertex).root == vertex) births.push_back(birth_[vertex]);
    return births;
  }

 private:
  DisjointSets sets_;
  std::vector<double> birth_;  ///< births of the roots
};

/// Sorted projections of the points of a diagram onto the lines of all directions, directly and after
/// projection onto the diagonal.
struct Projections {
  std::array<std::vector<double>, slices> points, on_diagonal;
};

/// Sorts in ascending order. Loops are often in descending order already.
void sort_ascending(std::vector<double>& places) {
  if (std::ranges::is_sorted(places, std::greater()))
    std::ranges::reverse(places);
  else
    std::ranges::sort(places);
}

Projections project(std::span<const Lifetime> lifetimes) {
  std::vector<double> sums;
  for (const Lifetime& point : lifetimes) sums.push_back(point.birth + point.death);
  sort_ascending(sums);
  Projections projections;
  for (std::size_t slice = 0; slice < slices; ++slice) {
    const double direction = pi * (static_cast<double>(slice) / slices - 0.5);
    const double x = cosine(direction), y = sine(direction);
    std::vector<double>&points = projections.points[slice], &on_diagonal = projections.on_diagonal[slice];
    points.reserve(lifetimes.size());
    for (const Lifetime& point : lifetimes) points.push_back(x * point.birth + y * point.death);
    sort_ascending(points);
    on_diagonal.reserve(lifetimes.size());
    for (const double sum : sums) on_diagonal.push_back(0.5 * (x + y) * sum);
    sort_ascending(on_diagonal);
  }
  return projections;
}

/// Returns the sliced distance of two diagrams from their projections.
double distance(const Projections& one, const Projections& other) {
  double sum = 0.0;
  std::vector<double> mine, its;
  for (std::size_t slice = 0; slice < slices; ++slice) {
    mine.clear();
    its.clear();
    std::ranges::merge(one.points[slice], other.on_diagonal[slice], std::back_inserter(mine));
    std::ranges::merge(other.points[slice], one.on_diagonal[slice], std::back_inserter(its));
    for (std::size_t k = 0; k < mine.size(); ++k) sum += std::abs(mine[k] - its[k]);
  }
  return sum / slices;
}

}  // namespace

PersistenceDiagram force_persistence(const BedFrame& bed, double force) {
  const FrameContacts& contacts = bed.frame.contacts;
  PersistenceDiagram diagram;
  GrowingGraph graph(bed.statics.free_count);
  for (const Index c : contacts_by_force(bed)) {
    const double now = contacts.fn[c] / force;
    const Index one = graph.component(contacts.a[c], now), other = graph.component(contacts.b[c], now);
    if (one == other)
      diagram.loops.push_back({now, 0.0});
    else if (const double birth = graph.merge(one, other); birth > now)
      diagram.components.push_back({birth, now});
  }
  for (const double birth : graph.births()) diagram.components.push_back({birth, 0.0});
  return diagram;
}

GraphCount count_at(const PersistenceDiagram& diagram, double threshold) {
  // A component no longer exists at the threshold at which it meets another; one that lasts to 0 exists at 0.
  const auto is_there = [&](const Lifetime& lifetime) {
    return lifetime.birth >= threshold && (lifetime.death < threshold || lifetime.death == 0.0);
  };
  return {static_cast<Index>(std::ranges::count_if(diagram.components, is_there)),
          static_cast<Index>(std::ranges::count_if(diagram.loops, is_there))};
}

double total_persistence(std::span<const Lifetime> lifetimes) {
  double sum = 0.0;
  for (const Lifetime& lifetime : lifetimes) sum += lifetime.birth - lifetime.death;
  return sum;
}

double sliced_distance(std::span<const Lifetime> one, std::span<const Lifetime> other) {
  return distance(project(one), project(other));
}

void measure_topology(const PersistenceDiagram& diagram, Index free_count, std::span<const double> thresholds,
                      FrameRecord& record) {
  for (const double threshold : thresholds) {
    const GraphCount count = count_at(diagram, threshold);
    record.network_components.push_back(count.components);
    record.network_loops.push_back(count.loops);
  }
  record.component_persistence = total_persistence(diagram.components) / free_count;
  record.loop_persistence = total_persistence(diagram.loops) / free_count;
}

void measure_network_changes(const std::vector<PersistenceDiagram>& diagrams, Index free_count,
                             std::vector<FrameRecord>& frames) {
  std::array<Projections, 2> before, now;
  for (std::size_t k = 0; k < frames.size(); ++k, std::swap(before, now)) {
    now = {project(diagrams[k].components), project(diagrams[k].loops)};
    if (k == 0) continue;
    for (std::size_t s = 0; s < now.size(); ++s)
      frames[k].network_change[s] = distance(before[s], now[s]) / free_count;
  }
}

}  // namespace talus::analysis
