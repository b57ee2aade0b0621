#include "analysis/overload/percolation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/random.h"
#include "core/trigonometry.h"
#include "unit/analysis/packings.h"

namespace talus::analysis {
namespace {

using test::Packing;

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
