/// Links between grains, and the clusters that they make.

#include "analysis/overload/clusters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/random.h"
#include "core/trigonometry.h"
#include "unit/analysis/packings.h"

namespace talus::analysis {
namespace {

using Graph = std::vector<std::vector<Index>>;

/// Assigns `label` to everything connected to `start` that has no label.
Index flood(const Graph& graph, std::vector<Index>& labels, Index start, Index label) {
  std::vector<Index> open = {start};
  Index size = 0;
  labels[start] = label;
  while (!open.empty()) {
    const Index i = open.back();
    open.pop_back();
    ++size;
    for (Index j : graph[i])
      if (labels[j] == -1) {
        labels[j] = label;
        open.push_back(j);
      }
  }
  return size;
}

std::vector<Link> random_links(Random& random, Index count, int number) {
  std::vector<Link> links;
  for (int k = 0; k < number; ++k) {
    const auto a = static_cast<Index>(random.below(static_cast<std::uint32_t>(count)));
    const auto b = static_cast<Index>(random.below(static_cast<std::uint32_t>(count)));
    if (a != b) links.push_back({std::min(a, b), std::max(a, b), 0});
  }
  return links;
}

TEST(Clusters, are_those_of_a_flood_fill) {
  constexpr Index count = 300;
  Random random(11);
  for (const int number : {100, 250, 400, 1000}) {
    const std::vector<Link> links = random_links(random, count, number);
    std::vector<bool> in_set(count);
    for (Index i = 0; i < count; ++i) in_set[i] = random.uniform() < 0.8;
    const Clusters clusters = find_clusters(in_set, links, std::vector<double>(count, 0.0), 0.0);

    Graph graph(count);
    for (const Link& link : links)
      if (in_set[link.a] && in_set[link.b]) {
        graph[link.a].push_back(link.b);
        graph[link.b].push_back(link.a);
      }
    std::vector<Index> flooded(count, -1);
    for (Index i = 0; i < count; ++i) {
      if (!in_set[i]) {
        EXPECT_EQ(clusters.label[i], -1);
      } else if (flooded[i] == -1) {
        const Index label = clusters.label[i];
        ASSERT_TRUE(label >= 0 && label < clusters.count());
        EXPECT_EQ(flood(graph, flooded, i, label), clusters.size[label]);
      }
    }
    EXPECT_EQ(flooded, clusters.label);
    // Larger clusters first; among equal ones, the one that begins first.
    std::vector<std::pair<Index, std::ptrdiff_t>> order;
    for (Index k = 0; k < clusters.count(); ++k)
      order.emplace_back(-clusters.size[k], std::ranges::find(clusters.label, k) - clusters.label.begin());
    EXPECT_TRUE(std::ranges::is_sorted(order));
    EXPECT_EQ(clusters.members, std::ranges::count(in_set, true));
  }
}

TEST(Clusters, are_ordered_by_size_and_then_by_id) {
  const std::vector<bool> in_set = {true, true, true, true, true, false, true, true};
  const std::vector<Link> links = {{1, 4}, {2, 3}, {4, 7}, {5, 6}, {0, 5}};
  const Clusters clusters = find_clusters(in_set, links, std::vector<double>(8, 0.0), 0.0);
  EXPECT_EQ(clusters.label, (std::vector<Index>{2, 0, 1, 1, 0, -1, 3, 0}));
  EXPECT_EQ(clusters.size, (std::vector<Index>{3, 2, 1, 1}));
  EXPECT_EQ(clusters.members, 7);
  EXPECT_EQ(mean_size(clusters), 7.0 / 4.0);
  EXPECT_EQ(largest_size(clusters), 3);
  EXPECT_EQ(largest_share(clusters), 3.0 / 7.0);
  EXPECT_EQ(second_moment(clusters), 15.0 / 7.0);
  EXPECT_EQ(second_moment_of_others(clusters), 6.0 / 4.0);
}

TEST(Clusters, of_an_empty_set) {
  const Clusters clusters = find_clusters({false, false}, {{0, 1}}, {0.0, 1.0}, 0.0);
  EXPECT_EQ(clusters.count(), 0);
  EXPECT_TRUE(std::isnan(mean_size(clusters)) && std::isnan(second_moment(clusters)));
  EXPECT_TRUE(std::isnan(correlation_length(clusters, {0.0, 0.0})));
}

/// Returns links from each of 0 ... 9 to the next, at x = 0.5 ... 9.5 in a period of 10.
std::vector<Link> ring() {
  std::vector<Link> links;
  for (Index i = 0; i + 1 < 10; ++i) links.push_back({i, i + 1, 0});
  links.push_back({0, 9, -1});
  return links;
}

TEST(Clusters, that_go_around_the_period_wrap) {
  std::vector<double> x;
  for (Index i = 0; i < 10; ++i) x.push_back(i + 0.5);
  std::vector<bool> in_set(10, true);
  EXPECT_TRUE(find_clusters(in_set, ring(), x, 10.0).wraps[0]);
  for (Index missing = 0; missing < 10; ++missing) {
    in_set.assign(10, true);
    in_set[missing] = false;
    const Clusters clusters = find_clusters(in_set, ring(), x, 10.0);
    EXPECT_EQ(clusters.count(), 1);
    EXPECT_FALSE(clusters.wraps[0]);
    // Unwrapped, the nine grains lie next to each other.
    double lowest = 1e9, highest = -1e9;
    for (Index i = 0; i < 10; ++i)
      if (in_set[i]) {
        lowest = std::min(lowest, clusters.unrolled[i]);
        highest = std::max(highest, clusters.unrolled[i]);
      }
    EXPECT_EQ(highest - lowest, 8.0);
  }
  // A loop that crosses the edge and returns through it does not wrap around.
  EXPECT_FALSE(
      find_clusters({true, true, true}, {{0, 1, -1}, {0, 2, -1}, {1, 2, 0}}, {0.5, 9.5, 9.0}, 10.0).wraps[0]);
}

// Links in any order, so that merging roots have offsets on both sides.
TEST(Clusters, wrap_whatever_the_order_of_links) {
  std::vector<double> x;
  for (Index i = 0; i < 10; ++i) x.push_back(i + 0.5);
  Random random(12);
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<Link> links = ring();
    for (std::size_t k = links.size() - 1; k > 0; --k)
      std::swap(links[k], links[random.below(static_cast<std::uint32_t>(k + 1))]);
    EXPECT_TRUE(find_clusters(std::vector<bool>(10, true), links, x, 10.0).wraps[0]);
    links.pop_back();
    const Clusters open = find_clusters(std::vector<bool>(10, true), links, x, 10.0);
    EXPECT_FALSE(open.wraps[0]);
    const auto [lowest, highest] = std::ranges::minmax(open.unrolled);
    EXPECT_EQ(highest - lowest, 9.0);
  }
}

// R^2 of two grains at distance d is d^2/4, and for a single pair xi = d / sqrt(2). Pairs count with s^2 = 4;
// single grains and wrapping clusters do not count.
TEST(CorrelationLength, of_pairs) {
  const std::vector<double> x = {9.5, 0.5, 3.0, 3.0, 6.0};
  const std::vector<double> y = {0.0, 0.0, 0.0, 3.0, 5.0};
  const std::vector<Link> one = {{0, 1, 1}};
  const std::vector<Link> two = {{0, 1, 1}, {2, 3, 0}};
  const auto length = [&](const std::vector<Link>& links) {
    return correlation_length(find_clusters(std::vector<bool>(5, true), links, x, 10.0), y);
  };
  EXPECT_NEAR(length(one), 1.0 / std::sqrt(2.0), 1e-15);
  EXPECT_NEAR(length(two), std::sqrt(2.0 * (0.25 + 2.25) / 2.0), 1e-15);
  EXPECT_NEAR(length({{0, 1, 1}, {0, 1, 0}, {2, 3, 0}}), std::sqrt(2.0 * 2.25), 1e-15);
}

using test::Packing;

std::vector<std::pair<Index, Index>> pairs(const std::vector<Link>& links) {
  std::vector<std::pair<Index, Index>> result;
  for (const Link& link : links) result.emplace_back(link.a, link.b);
  return result;
}

TEST(ForceLinks, join_free_grains_that_press_on_each_other) {
  Packing packing = test::empty_packing(10.0, true);
  const Index a = test::add_grain(packing, 0.25, 0.5);
  const Index b = test::add_grain(packing, 9.25, 0.5);
  const Index floor = test::add_floor_grain(packing, 0.25, -0.5);
  test::add_contact(packing, a, b, 1.0, 0.0, -1);
  test::add_contact(packing, a, floor, 1.0);
  const std::vector<Link> links = force_links(packing);
  ASSERT_EQ(links.size(), 1u);
  EXPECT_EQ(links[0].a, a);
  EXPECT_EQ(links[0].b, b);
  EXPECT_EQ(links[0].shift, -1);
}

TEST(NeighbourLinks, are_all_pairs_closer_than_the_reach) {
  for (const bool periodic : {false, true}) {
    const Packing packing = test::random_packing(7, 300, 20.0, 12.0, periodic);
    const Frame& frame = packing.frame;
    std::vector<std::pair<Index, Index>> expected;
    for (Index a = 0; a < 300; ++a)
      for (Index b = a + 1; b < 300; ++b) {
        double dx = std::fabs(frame.x[b] - frame.x[a]);
        if (periodic) dx = std::min(dx, 20.0 - dx);
        if (std::hypot(dx, frame.y[b] - frame.y[a]) <
            1.3 * (packing.statics.radius[a] + packing.statics.radius[b]))
          expected.emplace_back(a, b);
      }
    const std::vector<Link> links = neighbour_links({frame, packing.statics}, 1.3);
    EXPECT_EQ(pairs(links), expected);
    for (const Link& link : links)
      EXPECT_LT(std::fabs(frame.x[link.b] + 20.0 * link.shift - frame.x[link.a]), 2.0);
    EXPECT_EQ(std::ranges::any_of(links, [](const Link& link) { return link.shift != 0; }), periodic);
  }
}

SpanningClusters spanning(const Packing& packing, const std::vector<bool>& in_set) {
  const std::vector<Link> links = neighbour_links(packing);
  const double period = packing.statics.periodic ? packing.statics.length : 0.0;
  return find_spanning(find_clusters(in_set, links, packing.frame.x, period), bed_edges(packing));
}

// Site percolation on a triangular lattice has p_c = 1/2 (Sykes and Essam 1964).
TEST(Spanning, of_a_triangular_lattice_begins_at_one_half) {
  for (const bool periodic : {false, true}) {
    const Packing packing = test::triangular_lattice(40, 46, periodic);
    for (const std::uint64_t seed : {1, 2, 3, 4}) {
      Random random(seed);
      std::vector<bool> low, high;
      for (Index i = 0; i < packing.statics.free_count; ++i) {
        const double draw = random.uniform();
        low.push_back(draw < 0.4);
        high.push_back(draw < 0.6);
      }
      const SpanningClusters below = spanning(packing, low);
      EXPECT_EQ(below.floor_to_surface, -1);
      EXPECT_EQ(below.across, -1);
      const SpanningClusters above = spanning(packing, high);
      EXPECT_EQ(above.floor_to_surface, 0);
      EXPECT_EQ(above.across, 0);
    }
  }
}

// On a triangular lattice a cluster that crosses the bed prevents all others from crossing it in the other
// direction.
TEST(Spanning, of_a_row_and_of_a_column) {
  const Packing packing = test::triangular_lattice(12, 9, true);
  std::vector<bool> row(108, false), column(108, false);
  for (Index k = 0; k < 12; ++k) row[4 * 12 + k] = true;
  for (Index k = 0; k < 9; ++k) column[k * 12 + 3] = true;
  EXPECT_EQ(spanning(packing, row).across, 0);
  EXPECT_EQ(spanning(packing, row).floor_to_surface, -1);
  EXPECT_EQ(spanning(packing, column).across, -1);
  EXPECT_EQ(spanning(packing, column).floor_to_surface, 0);
  row[4 * 12 + 7] = false;
  column[4 * 12 + 3] = false;
  EXPECT_EQ(spanning(packing, row).across, -1);
  EXPECT_EQ(spanning(packing, column).floor_to_surface, -1);
}

TEST(Spanning, is_known_of_each_cluster) {
  const Packing packing = test::triangular_lattice(12, 9, true);
  std::vector<bool> columns(108, false);
  for (Index k = 0; k < 9; ++k) columns[k * 12 + 3] = columns[k * 12 + 8] = true;
  for (Index k = 2; k < 6; ++k) columns[k * 12 + 11] = columns[k * 12] = true;
  EXPECT_EQ(spanning(packing, columns).each, (std::vector<bool>{true, true, false}));
  std::vector<bool> rows(108, false);
  for (Index k = 0; k < 12; ++k) rows[12 + k] = rows[6 * 12 + k] = true;
  rows[6 * 12 + 4] = false;
  EXPECT_EQ(spanning(packing, rows).each, (std::vector<bool>{true, false})) << "along the bed";
}

TEST(Spanning, is_that_of_the_largest) {
  const Packing packing = test::triangular_lattice(12, 9, true);
  std::vector<bool> rows(108, false);
  for (Index row : {1, 5, 6})
    for (Index k = 0; k < 12; ++k) rows[row * 12 + k] = true;
  EXPECT_EQ(spanning(packing, rows).across, 0);
}

TEST(Spanning, does_not_depend_on_where_the_period_is_cut) {
  const Packing packing = test::triangular_lattice(12, 9, true);
  std::vector<bool> row(108, false);
  for (Index k = 0; k < 12; ++k) row[4 * 12 + k] = true;
  for (const double shift : {0.5, 5.0, 11.5}) EXPECT_EQ(spanning(test::moved(packing, shift), row).across, 0);
  row[4 * 12 + 7] = false;
  for (const double shift : {0.5, 5.0, 11.5})
    EXPECT_EQ(spanning(test::moved(packing, shift), row).across, -1);
}

TEST(BedEdges, are_where_the_bed_ends) {
  Packing packing = test::empty_packing(6.0, false);
  const Index low = test::add_grain(packing, 0.6, 0.5);
  const Index propped = test::add_grain(packing, 3.0, 1.2);
  const Index middle = test::add_grain(packing, 3.0, 2.5);
  const Index just_below = test::add_grain(packing, 3.4, 3.2);
  const Index top = test::add_grain(packing, 3.2, 4.0);
  const Index right = test::add_grain(packing, 5.0, 1.4);
  const Index floor = test::add_floor_grain(packing, 3.0, 0.0);
  test::add_contact(packing, propped, floor, 1.0);
  const BedEdges edges = bed_edges(packing);
  const auto ids = [](const std::vector<bool>& edge) {
    std::vector<Index> result;
    for (std::size_t i = 0; i < edge.size(); ++i)
      if (edge[i]) result.push_back(static_cast<Index>(i));
    return result;
  };
  EXPECT_EQ(ids(edges.floor), (std::vector<Index>{low, propped}));
  EXPECT_EQ(ids(edges.surface), (std::vector<Index>{low, just_below, top, right}));
  EXPECT_EQ(ids(edges.left), (std::vector<Index>{low}));
  EXPECT_EQ(ids(edges.right), (std::vector<Index>{right}));
  EXPECT_FALSE(edges.floor[middle] || edges.surface[middle]);
  packing.statics.periodic = true;
  EXPECT_TRUE(ids(bed_edges(packing).left).empty());
}

/// Returns grains on a path upwards from the floor; its steps, one diameter long, have these angles (deg).
Packing path(const std::vector<double>& angles, bool periodic = false) {
  Packing packing = test::empty_packing(20.0, periodic);
  double x = 10.0;
  double y = 0.5;
  test::add_grain(packing, x, y);
  for (double angle : angles) {
    x += std::cos(radians(angle));
    y += std::sin(radians(angle));
    test::add_grain(packing, periodic ? x - 20.0 * std::floor(x / 20.0) : x, y);
  }
  return packing;
}

/// Returns the first grain as floor contact and the last as surface.
BedEdges ends_of(const Packing& packing) {
  const auto count = static_cast<std::size_t>(packing.statics.free_count);
  const std::vector<bool> none(count, false);
  BedEdges edges = {none, none, none, none};
  edges.floor.front() = true;
  edges.surface.back() = true;
  return edges;
}

DirectedPaths along(const Packing& packing, double direction, double spread = 30.0) {
  return directed_paths(
      packing, std::vector<bool>(static_cast<std::size_t>(packing.statics.free_count), true),
      neighbour_links(packing, 1.01), ends_of(packing), radians(direction), radians(spread));
}

TEST(DirectedPaths, advance_with_every_step) {
  const Packing straight = path({60, 60, 60, 60, 60, 60});
  EXPECT_TRUE(along(straight, 60.0).spans);
  EXPECT_NEAR(along(straight, 60.0).height, 6.0 * std::sqrt(0.75), 1e-12);
  EXPECT_FALSE(along(straight, 120.0).spans);
  EXPECT_EQ(along(straight, 120.0).height, 0.0);
  EXPECT_TRUE(along(path({60, 35, 85, 60}), 60.0).spans);
  const DirectedPaths bent = along(path({60, 60, 120, 60, 60, 60}), 60.0);
  EXPECT_FALSE(bent.spans);
  EXPECT_NEAR(bent.height, 3.0 * std::sqrt(0.75), 1e-12);
  EXPECT_FALSE(along(path({60, 25, 60}), 60.0).spans);
}

// From the floor up to a summit, one step down to another grain, and from there up to the surface: all links
// are within 40 deg of the vertical, but a path must not descend.
TEST(DirectedPaths, do_not_turn_back) {
  const Packing packing = path({60, 60, 60, -60, 60, 60});
  EXPECT_TRUE(along(path({60, 60, 60, 60, 60}), 90.0, 40.0).spans);
  EXPECT_FALSE(along(packing, 90.0, 40.0).spans);
  EXPECT_NEAR(along(packing, 90.0, 40.0).height, 3.0 * std::sqrt(0.75), 1e-12);
}

TEST(DirectedPaths, do_not_depend_on_ids) {
  const Packing packing = path({-120, -120, -120, -120});
  BedEdges edges = ends_of(packing);
  std::swap(edges.floor, edges.surface);
  const DirectedPaths paths =
      directed_paths(packing, std::vector<bool>(5, true), neighbour_links(packing, 1.01), edges,
                     radians(60.0), radians(30.0));
  EXPECT_TRUE(paths.spans);
  EXPECT_NEAR(paths.height, 4.0 * std::sqrt(0.75), 1e-12);
}

TEST(DirectedPaths, of_one_grain_that_is_the_whole_bed) {
  EXPECT_TRUE(along(path({}), 60.0).spans);
  EXPECT_EQ(along(path({}), 60.0).height, 0.0);
}

TEST(DirectedPaths, go_through_the_edge_of_the_period) {
  const std::vector<double> slope(20, 40.0);
  EXPECT_TRUE(along(path(slope, true), 60.0).spans);
  EXPECT_TRUE(along(test::mirrored(path(slope, true)), 120.0).spans);
  EXPECT_FALSE(along(test::mirrored(path(slope, true)), 60.0).spans);
}

TEST(DirectedPaths, stay_in_the_set) {
  const Packing packing = path({60, 60, 60});
  const std::vector<Link> links = neighbour_links(packing);
  const BedEdges edges = ends_of(packing);
  const auto spans = [&](const std::vector<bool>& in_set) {
    return directed_paths(packing, in_set, links, edges, radians(60.0), radians(30.0)).spans;
  };
  EXPECT_TRUE(spans({true, true, true, true}));
  EXPECT_FALSE(spans({true, false, true, true}));
  EXPECT_FALSE(spans({false, true, true, true}));
  EXPECT_FALSE(spans({true, true, true, false}));
}

}  // namespace
}  // namespace talus::analysis
