#include "analysis/topology/topology.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iterator>
#include <utility>

#include "analysis/overload/clusters.h"
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

namespace {

constexpr Index nobody = -1;

/// Pebble game in which each body has three pebbles, one for each degree of freedom. A pebble is free, or
/// covers a constraint to another body. Three pebbles can always be brought to two bodies: their common
/// motion. A constraint is independent if a fourth pebble can be brought to its two bodies. If not, these
/// bodies and all bodies met in the search are rigid together and are merged into one body, so a search
/// visits a rigid cluster once, however large it is.
class PebbleGame {
 public:
  explicit PebbleGame(Index bodies)
      : bodies_(bodies),
        pebbles_(size(), {nobody, nobody, nobody}),
        seen_(size(), 0),
        from_(size(), nobody) {}

  /// Returns whether the constraint is independent of the preceding ones.
  bool add_constraint(Index a, Index b) {
    const Index u = root(a), v = root(b);
    if (u == v || join_if_rigid(u, v)) return false;
    const Index covering = free_of(u) > 0 ? u : v;
    *std::ranges::find(pebbles_[covering], nobody) = covering == u ? v : u;
    join_if_rigid(u, v);
    return true;
  }

  /// Joins two bodies, with all bodies that their pebbles lead to, if they can only move as one. Returns
  /// whether they were joined.
  bool join_if_rigid(Index u, Index v) {
    while (free_of(u) + free_of(v) < 4)
      if (!bring_pebble(u, v) && !bring_pebble(v, u)) {
        make_rigid(u, v);
        return true;
      }
    return false;
  }

  Index root(Index body) { return sets_.find(body).root; }

 private:
  std::size_t size() const { return bodies_; }

  Index free_of(Index body) const { return static_cast<Index>(std::ranges::count(pebbles_[body], nobody)); }

  /// Follows covered constraints from `to` to a free pebble on another body than `to` and `other`, and moves
  /// it to `to`. Each constraint on the path is then covered from its other end.
  bool bring_pebble(Index to, Index other) {
    ++search_;
    seen_[to] = seen_[other] = search_;
    path_.assign(1, to);
    for (std::size_t next = 0; next < path_.size(); ++next) {
      const Index body = path_[next];
      for (const Index covered : pebbles_[body]) {
        if (covered == nobody) continue;
        const Index end = root(covered);
        if (seen_[end] == search_) continue;
        seen_[end] = search_;
        from_[end] = body;
        if (free_of(end) > 0) {
          move_pebble(end, to);
          return true;
        }
        path_.push_back(end);
      }
    }
    return false;
  }

  void move_pebble(Index body, Index to) {
    while (body != to) {
      const Index before = from_[body];
      *std::ranges::find(pebbles_[body], nobody) = before;
      *std::ranges::find_if(pebbles_[before], [&](Index covered) {
        return covered != nobody && root(covered) == body;
      }) = nobody;
      body = before;
    }
  }

  /// Joins u and v, which hold the last three pebbles, and all bodies that can be reached from them.
  void make_rigid(Index u, Index v) {
    ++search_;
    cluster_.clear();
    for (const Index body : {u, v}) add_to_cluster(body);
    for (std::size_t next = 0; next < cluster_.size(); ++next)
      for (const Index covered : pebbles_[cluster_[next]])
        if (covered != nobody) add_to_cluster(root(covered));
    for (const Index body : cluster_) sets_.join(cluster_.front(), body, 0);
    pebbles_[root(cluster_.front())] = {nobody, nobody, nobody};
  }

  void add_to_cluster(Index body) {
    if (seen_[body] == search_) return;
    seen_[body] = search_;
    cluster_.push_back(body);
  }

  Index bodies_;
  DisjointSets sets_{size()};
  /// For each root, the bodies to which its pebbles lead, or nobody.
  std::vector<std::array<Index, 3>> pebbles_;
  std::vector<std::int64_t> seen_;  ///< last search that visited each body
  std::vector<Index> from_;         ///< preceding body in the last search
  std::vector<Index> path_, cluster_;
  std::int64_t search_ = 0;
};

}  // namespace

RigidClusters find_rigid_clusters(Index bodies, std::span<const Bond> bonds) {
  PebbleGame game(bodies);
  RigidClusters clusters;
  for (const Bond& bond : bonds)
    for (int k = 0; k < bond.constraints; ++k)
      ++(game.add_constraint(bond.a, bond.b) ? clusters.independent : clusters.redundant);
  // A body that is held by a cluster without a pebble leading to it has not been joined yet.
  for (const Bond& bond : bonds) {
    const Index a = game.root(bond.a), b = game.root(bond.b);
    if (a != b) game.join_if_rigid(a, b);
  }
  for (Index body = 0; body < bodies; ++body) clusters.label.push_back(game.root(body));
  return clusters;
}

std::vector<Bond> bonds_of(const BedFrame& bed) {
  const FrameContacts& contacts = bed.frame.contacts;
  const Index fixed = bed.statics.free_count;
  std::vector<Bond> bonds;
  for (Index c = 0; c < contacts.count(); ++c)
    bonds.push_back({std::min(contacts.a[c], fixed), std::min(contacts.b[c], fixed),
                     contacts.status[c] == ContactStatus::sliding ? 1 : 2});
  return bonds;
}

void measure_rigid_clusters(const BedFrame& bed, FrameRecord& record) {
  if (bed.frame.friction.grains == 0.0) {  // rotations without resistance would count as motions
    record.rigid_clusters = -1;
    return;
  }
  const Index fixed = bed.statics.free_count;
  const std::vector<Bond> bonds = bonds_of(bed);
  const RigidClusters clusters = find_rigid_clusters(fixed + 1, bonds);
  std::vector<Index> bodies(clusters.label.size(), 0), grains(clusters.label.size(), 0);
  std::vector<bool> carries(clusters.label.size(), false);
  Index inside = 0;
  for (const Bond& bond : bonds) {
    carries[bond.a] = carries[bond.b] = true;
    inside += clusters.label[bond.a] == clusters.label[bond.b] ? 1 : 0;
  }
  for (Index body = 0; body <= fixed; ++body) {
    ++bodies[clusters.label[body]];
    grains[clusters.label[body]] += body < fixed ? 1 : 0;
  }
  Index largest = 0;
  for (std::size_t k = 0; k < bodies.size(); ++k)
    if (bodies[k] > 1) {
      ++record.rigid_clusters;
      largest = std::max(largest, grains[k]);
    }
  const auto carrying = static_cast<double>(std::count(carries.begin(), carries.begin() + fixed, true));
  record.rigid_largest_share = largest / carrying;
  record.rigid_contact_share = static_cast<double>(inside) / static_cast<double>(bonds.size());
  record.rigid_floppy_modes = (3.0 * carrying - clusters.independent) / carrying;
  record.rigid_redundant = clusters.redundant / carrying;
}

}  // namespace talus::analysis
