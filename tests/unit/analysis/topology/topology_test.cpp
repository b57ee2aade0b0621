/// Topology and rigid clusters of contact networks.

#include "analysis/topology/topology.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include "core/random.h"
#include "core/trigonometry.h"
#include "unit/analysis/packings.h"

namespace talus::analysis {
namespace {

using test::Packing;

/// Returns two triangles on a floor grain, connected by a bridge.
Packing two_triangles() {
  Packing packing = test::empty_packing(10.0, false);
  for (Index i = 0; i < 7; ++i) test::add_grain(packing, static_cast<double>(i), 0.5);
  const Index floor = test::add_floor_grain(packing, 0.0, -0.5);
  test::add_contact(packing, 0, 1, 4.0);
  test::add_contact(packing, 1, 2, 3.0);
  test::add_contact(packing, 0, 2, 2.0);
  test::add_contact(packing, 3, 4, 4.0);
  test::add_contact(packing, 4, 5, 3.0);
  test::add_contact(packing, 3, 5, 3.0);
  test::add_contact(packing, 2, 3, 1.0);
  test::add_contact(packing, 0, floor, 9.0);
  test::add_contact(packing, 5, floor, 9.0);
  return packing;
}

std::vector<GraphCount> count_networks(const BedFrame& bed, const std::vector<double>& thresholds) {
  std::vector<GraphCount> counts;
  for (const double threshold : thresholds)
    counts.push_back(count_at(force_persistence(bed, 1.0), threshold));
  return counts;
}

std::vector<Index> numbers(const std::vector<GraphCount>& counts, Index GraphCount::*member) {
  std::vector<Index> values;
  for (const GraphCount& count : counts) values.push_back(count.*member);
  return values;
}

TEST(Topology, counts_components_and_loops_above_each_threshold) {
  const std::vector<GraphCount> counts = count_networks(two_triangles(), {0.0, 1.0, 1.5, 2.5, 3.5, 4.0, 4.5});
  EXPECT_EQ(numbers(counts, &GraphCount::components), (std::vector<Index>{1, 1, 2, 2, 2, 2, 0}));
  EXPECT_EQ(numbers(counts, &GraphCount::loops), (std::vector<Index>{2, 2, 2, 1, 0, 0, 0}));
}

// Four grains in a row that wraps around the period.
TEST(Topology, a_row_around_the_period_is_a_loop) {
  Packing packing = test::empty_packing(4.0, true);
  for (Index i = 0; i < 4; ++i) test::add_grain(packing, i + 0.5, 0.5);
  for (Index i = 0; i < 3; ++i) test::add_contact(packing, i, i + 1, 1.0);
  test::add_contact(packing, 0, 3, 1.0, 0.0, -1);
  const std::vector<GraphCount> counts = count_networks(packing, {1.0});
  EXPECT_EQ(counts[0].components, 1);
  EXPECT_EQ(counts[0].loops, 1);
}

TEST(Topology, thresholds_are_of_the_mean_force) {
  const Packing packing = two_triangles();
  FrameRecord record;
  measure_topology(force_persistence(packing, 2.0), 7, std::vector<double>{0.5, 0.75, 2.0}, record);
  EXPECT_EQ(record.network_components, (std::vector<double>{1.0, 2.0, 2.0}));
  EXPECT_EQ(record.network_loops, (std::vector<double>{2.0, 2.0, 0.0}));
}

/// Returns (birth, death) pairs, earliest birth first, and among equal births latest death first.
std::vector<std::pair<double, double>> in_order(const std::vector<Lifetime>& lifetimes) {
  std::vector<std::pair<double, double>> pairs;
  for (const Lifetime& lifetime : lifetimes) pairs.emplace_back(lifetime.birth, lifetime.death);
  std::ranges::sort(pairs, std::greater());
  return pairs;
}

using Pairs = std::vector<std::pair<double, double>>;

// Both triangles are born at 4 N/m; the bridge, at 1 N/m, ends one of them.
TEST(Topology, a_component_dies_where_it_meets_an_older_one) {
  const PersistenceDiagram diagram = force_persistence(two_triangles(), 2.0);
  EXPECT_EQ(in_order(diagram.components), (Pairs{{2.0, 0.5}, {2.0, 0.0}}));
  EXPECT_EQ(in_order(diagram.loops), (Pairs{{1.5, 0.0}, {1.0, 0.0}}));
}

// In a row with forces 5 1 4 2 3, the component of 3 meets that of 4, which is older, and then that of 5.
TEST(Topology, the_younger_of_two_components_dies) {
  Packing packing = test::empty_packing(10.0, false);
  for (Index i = 0; i < 6; ++i) test::add_grain(packing, static_cast<double>(i), 0.5);
  const double forces[] = {5.0, 1.0, 4.0, 2.0, 3.0};
  for (Index i = 0; i < 5; ++i) test::add_contact(packing, i, i + 1, forces[i]);
  const PersistenceDiagram diagram = force_persistence(packing, 1.0);
  EXPECT_EQ(in_order(diagram.components), (Pairs{{5.0, 0.0}, {4.0, 1.0}, {3.0, 2.0}}));
  EXPECT_TRUE(diagram.loops.empty());
  EXPECT_EQ(total_persistence(diagram.components), 9.0);
}

TEST(Topology, equal_forces_make_one_component) {
  Packing packing = test::empty_packing(10.0, false);
  for (Index i = 0; i < 4; ++i) test::add_grain(packing, static_cast<double>(i), 0.5);
  for (Index i = 0; i < 3; ++i) test::add_contact(packing, i, i + 1, 2.0);
  EXPECT_EQ(in_order(force_persistence(packing, 1.0).components), (Pairs{{2.0, 0.0}}));
}

double sliced_distance(const std::vector<Lifetime>& one, const std::vector<Lifetime>& other) {
  std::vector<FrameRecord> frames(2);
  measure_network_changes({{one, {}}, {other, {}}}, 1, frames);
  return frames[1].network_change[0];
}

// A point with birth b and death 0 is at distance b/2 |cos a - sin a| from the diagonal along direction a.
// The mean over all directions is sqrt(2) b / pi, which sixteen directions approximate within 0.4 %.
TEST(Topology, distance_to_an_empty_diagram_is_that_to_the_diagonal) {
  const std::vector<Lifetime> one = {{3.0, 0.0}}, none;
  EXPECT_NEAR(sliced_distance(one, none), 3.0 * 2.0 / pi * std::numbers::sqrt2 / 2.0, 0.01);
  EXPECT_EQ(sliced_distance(none, none), 0.0);
}

TEST(Topology, distance_is_a_metric_of_diagrams) {
  const std::vector<Lifetime> one = {{3.0, 0.0}, {2.0, 1.0}}, two = {{2.0, 1.0}, {3.5, 0.0}},
                              three = {{1.0, 0.5}, {1.2, 0.1}, {4.0, 3.9}};
  EXPECT_EQ(sliced_distance(one, std::vector{one[1], one[0]}), 0.0);
  EXPECT_EQ(sliced_distance(one, two), sliced_distance(two, one));
  EXPECT_GT(sliced_distance(one, two), 0.1);
  EXPECT_LE(sliced_distance(one, three), sliced_distance(one, two) + sliced_distance(two, three));
}

TEST(Topology, change_is_from_the_frame_before_and_for_each_grain) {
  std::vector<FrameRecord> frames(3);
  std::vector<PersistenceDiagram> diagrams(3);
  diagrams[1].components = {{2.0, 1.0}};
  diagrams[2].components = {{2.0, 1.0}};
  diagrams[2].loops = {{1.0, 0.0}};
  measure_network_changes(diagrams, 10, frames);
  EXPECT_TRUE(std::isnan(frames[0].network_change[0]) && std::isnan(frames[0].network_change[1]));
  EXPECT_DOUBLE_EQ(frames[1].network_change[0], sliced_distance(diagrams[1].components, {}) / 10.0);
  EXPECT_EQ(frames[1].network_change[1], 0.0);
  EXPECT_EQ(frames[2].network_change[0], 0.0);
  EXPECT_GT(frames[2].network_change[1], 0.0);
}

/// Computes the same by linear algebra: the rank of the constraint matrix at random places, and the bodies
/// with equal motion in all of its null space.
RigidClusters by_linear_algebra(Index bodies, const std::vector<Bond>& bonds, Random& random) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(2 * static_cast<Index>(bonds.size()), 3 * bodies);
  Index row = 0;
  for (const Bond& bond : bonds) {
    const double x = random.uniform(-1.0, 1.0), y = random.uniform(-1.0, 1.0);
    for (int k = 0; k < bond.constraints; ++k, ++row) {  // no relative motion of the bodies at (x, y) along d
      const double dx = random.uniform(-1.0, 1.0), dy = random.uniform(-1.0, 1.0);
      const Eigen::RowVector3d force(dx, dy, x * dy - y * dx);
      matrix.block<1, 3>(row, 3 * bond.a) -= force;
      matrix.block<1, 3>(row, 3 * bond.b) += force;
    }
  }
  const Eigen::FullPivLU<Eigen::MatrixXd> decomposition(matrix.topRows(row));
  const Eigen::MatrixXd motions = decomposition.kernel();
  RigidClusters clusters;
  clusters.independent = static_cast<Index>(decomposition.rank());
  clusters.redundant = row - clusters.independent;
  for (Index body = 0; body < bodies; ++body) {
    Index first = 0;
    while (!motions.middleRows(3 * body, 3).isApprox(motions.middleRows(3 * first, 3), 1e-7)) ++first;
    clusters.label.push_back(first);
  }
  return clusters;
}

std::vector<Bond> random_bonds(Index bodies, Index count, Random& random) {
  std::vector<Bond> bonds;
  while (static_cast<Index>(bonds.size()) < count) {
    const auto a = static_cast<Index>(random.below(bodies)), b = static_cast<Index>(random.below(bodies));
    if (a != b) bonds.push_back({a, b, random.below(3) == 0 ? 1 : 2});
  }
  return bonds;
}

// 30 networks of 12 bodies, from too few constraints to more than enough.
TEST(RigidClusters, agree_with_the_rank_of_the_constraint_matrix) {
  Random random(7);
  Index rigid = 0;
  for (Index trial = 0; trial < 30; ++trial) {
    const std::vector<Bond> bonds = random_bonds(12, 8 + trial / 2, random);
    const RigidClusters game = find_rigid_clusters(12, bonds);
    const RigidClusters algebra = by_linear_algebra(12, bonds, random);
    ASSERT_EQ(game.label, algebra.label) << trial;
    ASSERT_EQ(game.independent, algebra.independent) << trial;
    ASSERT_EQ(game.redundant, algebra.redundant) << trial;
    rigid += std::ranges::count(game.label, 0) > 1 ? 1 : 0;
  }
  EXPECT_GT(rigid, 5);  // the networks are of both kinds
  EXPECT_LT(rigid, 25);
}

TEST(RigidClusters, are_not_counted_without_friction) {
  Packing packing = test::empty_packing(10.0, false);
  for (Index i = 0; i < 3; ++i) test::add_grain(packing, static_cast<double>(i), 0.5);
  test::add_contact(packing, 0, 1, 1.0);
  test::add_contact(packing, 1, 2, 1.0);
  packing.frame.friction.grains = 0.0;
  FrameRecord record;
  measure_rigid_clusters(packing, record);
  EXPECT_EQ(record.rigid_clusters, -1);
  for (const double value : {record.rigid_largest_share, record.rigid_contact_share,
                             record.rigid_floppy_modes, record.rigid_redundant})
    EXPECT_TRUE(std::isnan(value));
}

// Two adjacent grains on the floor form a triangle with it; a third lies on them and slides at one; a fourth
// touches only the second, and rolls.
TEST(RigidClusters, of_a_bed_stand_on_its_floor) {
  Packing packing = test::empty_packing(10.0, false);
  for (Index i = 0; i < 4; ++i) test::add_grain(packing, static_cast<double>(i), 0.5);
  const Index floor = test::add_floor_grain(packing, 0.0, -0.5);
  test::add_floor_grain(packing, 1.0, -0.5);
  test::add_contact(packing, 0, 1, 1.0);
  test::add_contact(packing, 0, 2, 1.0, 0.5);
  test::add_contact(packing, 1, 2, 1.0);
  test::add_contact(packing, 1, 3, 1.0);
  test::add_contact(packing, 0, floor, 1.0);
  test::add_contact(packing, 1, floor + 1, 1.0);
  FrameRecord record;
  measure_rigid_clusters(packing, record);
  EXPECT_EQ(record.rigid_clusters, 1);
  EXPECT_EQ(record.rigid_largest_share, 0.75);
  EXPECT_EQ(record.rigid_contact_share, 5.0 / 6.0);
  EXPECT_EQ(record.rigid_floppy_modes, 0.25);
  EXPECT_EQ(record.rigid_redundant, 0.0);
}

}  // namespace
}  // namespace talus::analysis
