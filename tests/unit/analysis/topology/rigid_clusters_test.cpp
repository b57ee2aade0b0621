#include "analysis/topology/rigid_clusters.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "unit/analysis/packings.h"

namespace talus::analysis {
namespace {

using test::Packing;

std::vector<Index> labels(Index bodies, const std::vector<Bond>& bonds) {
  return find_rigid_clusters(bodies, bonds).label;
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

TEST(RigidClusters, three_grains_that_stick_are_rigid_and_four_in_a_ring_are_not) {
  EXPECT_EQ(labels(3, {{0, 1, 2}, {1, 2, 2}, {2, 0, 2}}), (std::vector<Index>{0, 0, 0}));
  EXPECT_EQ(labels(4, {{0, 1, 2}, {1, 2, 2}, {2, 3, 2}, {3, 0, 2}}), (std::vector<Index>{0, 1, 2, 3}));
}

// Each sliding contact removes one constraint, so the triangle lacks one.
TEST(RigidClusters, a_contact_that_slides_makes_a_triangle_floppy) {
  const RigidClusters clusters = find_rigid_clusters(3, std::vector<Bond>{{0, 1, 2}, {1, 2, 2}, {2, 0, 1}});
  EXPECT_EQ(clusters.label, (std::vector<Index>{0, 1, 2}));
  EXPECT_EQ(clusters.independent, 5);
  EXPECT_EQ(clusters.redundant, 0);
}

// Two triangles that share a grain are one body, because a grain has three degrees of freedom and is not a
// hinge.
TEST(RigidClusters, that_share_a_grain_are_one) {
  EXPECT_EQ(labels(5, {{0, 1, 2}, {1, 2, 2}, {2, 0, 2}, {2, 3, 2}, {3, 4, 2}, {4, 2, 2}}),
            (std::vector<Index>{0, 0, 0, 0, 0}));
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

TEST(RigidClusters, do_not_depend_on_the_order_of_the_bonds) {
  Random random(3);
  const std::vector<Bond> bonds = random_bonds(200, 320, random);
  const std::vector<Bond> reversed(bonds.rbegin(), bonds.rend());
  const std::vector<Index> label = labels(200, bonds);
  EXPECT_EQ(labels(200, reversed), label);
  EXPECT_GT(std::ranges::count(label, label[bonds[0].a]), 0);
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
