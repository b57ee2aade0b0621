#include "analysis/failure/failure_distance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/analysis/packings.h"

namespace talus::analysis {
namespace {

using test::Packing;

/// Returns two layers, of heights up to 1 and up to 2: two grains on the floor, one above and between them,
/// and one without contacts. N = 3, M = 5.
Packing two_layers() {
  Packing packing = test::empty_packing(10.0, false);
  const Index left = test::add_grain(packing, 2.0, 0.5);
  const Index right = test::add_grain(packing, 3.0, 0.5);
  const Index top = test::add_grain(packing, 2.5, 0.5 + std::sqrt(0.75));
  test::add_grain(packing, 8.0, 0.5);
  const Index floor = test::add_floor_grain(packing, 2.0, -0.5);
  test::add_contact(packing, left, right, 1.0);
  test::add_contact(packing, left, top, 1.0, 0.5);  // critical, because the friction is 0.5
  test::add_contact(packing, right, top, 1.0);
  test::add_contact(packing, left, floor, 1.0, -0.5);
  test::add_contact(packing, right, floor + 1, 1.0);  // walls are numbered after all grains
  return packing;
}

// 2 M = 10 components of forces and 9 equations: 2 - 9/5 = 1/5 of the contacts may be critical.
TEST(FailureDistance, bound_is_where_unknown_forces_are_as_many_as_equations) {
  FrameRecord record;
  measure_failure_distance(two_layers(), 2.0, record);
  EXPECT_NEAR(record.critical_bound, 0.2, 1e-15);
  EXPECT_NEAR(record.critical_share_of_bound, 2.0, 1e-14);  // two are critical, so this is not an equilibrium
}

// 10 components minus 5 for the contacts, which are all critical, and 6 equations without those of torques.
TEST(FailureDistance, without_friction_has_no_torques_to_balance) {
  Packing packing = two_layers();
  packing.frame.friction = {};
  FrameRecord record;
  measure_failure_distance(packing, 2.0, record);
  EXPECT_NEAR(record.critical_bound, 2.0 - 6.0 / 5.0, 1e-15);
  packing.frame.friction.walls = 0.5;
  packing.frame.contacts.nx.back() = 0.0;  // with the floor
  measure_failure_distance(packing, 2.0, record);
  EXPECT_NEAR(record.critical_bound, 2.0 - 6.0 / 5.0, 1e-15);
  packing.frame.contacts.nx.back() = 1.0;  // with a wall
  measure_failure_distance(packing, 2.0, record);
  EXPECT_NEAR(record.critical_bound, 2.0 - 7.0 / 5.0, 1e-15) << "the torque on one grain";
}

// The lower layer contains the contact of its two grains, half of each contact with the top grain, and those
// with floor and wall.
TEST(FailureDistance, counts_of_layers_add_up) {
  const std::vector<ForceCount> counts = count_forces(two_layers(), 2.0, 2);
  EXPECT_EQ(counts[0].grains, 2.0);
  EXPECT_EQ(counts[0].contacts, 4.0);
  EXPECT_EQ(counts[0].critical, 1.5);
  EXPECT_EQ(counts[1].grains, 1.0);
  EXPECT_EQ(counts[1].contacts, 1.0);
  EXPECT_EQ(counts[1].critical, 0.5);
  EXPECT_EQ(counts[0].share(), 0.375);
  EXPECT_EQ(counts[0].share_of_bound(), 0.75);
  EXPECT_TRUE(std::isnan(counts[1].share_of_bound()));  // 2 - 3 gives no bound
}

TEST(FailureDistance, grains_above_the_height_belong_to_the_last_layer) {
  const std::vector<ForceCount> counts = count_forces(two_layers(), 1.0, 4);
  EXPECT_EQ(counts[1].grains, 0.0);
  EXPECT_EQ(counts[2].grains, 2.0);
  EXPECT_EQ(counts[3].grains, 1.0);
}

TEST(FailureDistance, of_a_bed_without_contacts_is_not_known) {
  Packing packing = test::empty_packing(10.0, true);
  test::add_grain(packing, 2.0, 0.5);
  FrameRecord record;
  measure_failure_distance(packing, 1.0, record);
  EXPECT_TRUE(std::isnan(record.critical_bound));
  EXPECT_TRUE(std::isnan(record.critical_share_of_bound));
  EXPECT_EQ(record.layer_critical_share.size(), 10u);
}

}  // namespace
}  // namespace talus::analysis
