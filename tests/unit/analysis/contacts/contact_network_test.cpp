#include "analysis/contacts/contact_network.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/trigonometry.h"
#include "stress/internal_moment.h"
#include "stress/stress_state.h"
#include "unit/analysis/packings.h"

namespace talus::analysis {
namespace {

using test::Packing;

/// Returns the result of one of the functions for a packing.
FrameRecord found(void (*take)(const BedFrame&, FrameRecord&), const Packing& packing) {
  FrameRecord record;
  take(packing, record);
  return record;
}

/// Returns a triangle on the floor with an attached chain of two grains, and a grain without contacts.
Packing triangle_with_chain() {
  Packing packing = test::empty_packing(10.0, false);
  const Index left = test::add_grain(packing, 2.0, 0.5);
  const Index right = test::add_grain(packing, 3.0, 0.5);
  const Index top = test::add_grain(packing, 2.5, 0.5 + std::sqrt(0.75));
  const Index link = test::add_grain(packing, 3.5, 0.5 + std::sqrt(0.75));
  const Index end = test::add_grain(packing, 4.5, 0.5 + std::sqrt(0.75));
  test::add_grain(packing, 8.0, 0.5);
  const Index floor = test::add_floor_grain(packing, 2.0, -0.5);
  test::add_contact(packing, left, right, 1.0);
  test::add_contact(packing, left, top, 1.0);
  test::add_contact(packing, right, top, 1.0);
  test::add_contact(packing, top, link, 1.0);
  test::add_contact(packing, link, end, 1.0);
  test::add_contact(packing, left, floor, 1.0);
  return packing;
}

TEST(Coordination, counts_ends_at_free_grains) {
  const Packing packing = triangle_with_chain();
  const FrameRecord z = found(measure_coordination, packing);
  EXPECT_EQ(z.coordination_number, 11.0 / 5.0);
  EXPECT_EQ(z.coordination_number_of_all, 11.0 / 6.0);
}

// The end of the chain has one contact; without it, the next grain has one. The triangle keeps 3 * 2 + 1
// ends.
TEST(Coordination, without_rattlers_takes_them_away_again_and_again) {
  const Packing packing = triangle_with_chain();
  const FrameRecord z = found(measure_coordination, packing);
  EXPECT_EQ(z.coordination_number_without_rattlers, 7.0 / 3.0);
  EXPECT_EQ(z.rattler_fraction, 3.0 / 6.0);
}

TEST(NormalForces, over_their_mean) {
  Packing packing = triangle_with_chain();
  packing.frame.contacts.fn = {1.0, 1.0, 2.0, 2.0, 2.0, 4.0};  // mean 2
  const Histogram histogram = normal_forces(packing.frame, Histogram({0.0, 0.75, 1.5, 2.5}));
  EXPECT_EQ(histogram.weight, (std::vector<double>{2.0, 3.0, 1.0}));
}

TEST(MobilisedFriction, is_one_where_contacts_slide) {
  Packing packing = triangle_with_chain();
  packing.frame.contacts.ft = {0.0, 0.125, -0.125, 0.5, -0.5 * (1.0 + 1e-9), 0.3};
  const Histogram histogram = mobilised_friction(packing, 4);
  EXPECT_EQ(histogram.weight, (std::vector<double>{1.0, 2.0, 1.0, 2.0}));
  EXPECT_EQ(histogram.outside, 0.0);
}

// Walls may be rougher or smoother than grains, so contacts with walls have a different friction to mobilise.
TEST(MobilisedFriction, is_that_of_the_walls_at_walls_and_that_of_grains_at_the_floor) {
  Packing packing = triangle_with_chain();
  packing.frame.contacts.ft = {0.3, 0.3, 0.0, 0.0, 0.0, 0.0};
  packing.frame.contacts.fn.assign(6, 1.0);
  packing.frame.friction.walls = 1.0;
  for (std::size_t c : {0U, 1U}) packing.frame.contacts.b[c] = packing.frame.grain_count();
  packing.frame.contacts.nx[0] = -1.0;  // with the left wall
  packing.frame.contacts.ny[0] = 0.0;
  packing.frame.contacts.nx[1] = 0.0;  // with the floor
  packing.frame.contacts.ny[1] = -1.0;
  EXPECT_DOUBLE_EQ(mobilisation_of(packing, 0), 0.3);
  EXPECT_DOUBLE_EQ(mobilisation_of(packing, 1), 0.6);
  packing.frame.friction.walls = 0.0;
  packing.frame.contacts.ft[0] = 0.0;
  EXPECT_EQ(mobilisation_of(packing, 0), 1.0) << "nothing prevents sliding";
}

/// Returns a central grain with four neighbours: strong contacts along y, weak ones along x.
Packing cross(double strong, double weak) {
  Packing packing = test::empty_packing(10.0, false);
  test::add_grain(packing, 5.0, 5.0);
  test::add_grain(packing, 6.0, 5.0);
  test::add_grain(packing, 4.0, 5.0);
  test::add_grain(packing, 5.0, 6.0);
  test::add_grain(packing, 5.0, 4.0);
  for (Index i : {1, 2}) test::add_contact(packing, 0, i, weak);
  for (Index i : {3, 4}) test::add_contact(packing, 0, i, strong);
  return packing;
}

// Moments: strong 2 fn along y, weak 2 fn along x. Q of both is 2 (3 - 1), of which strong contacts give 3/2
// and weak ones -1/2.
TEST(Networks, share_the_stress) {
  const Packing packing = cross(3.0, 1.0);
  const FrameRecord result = found(measure_networks, packing);
  EXPECT_EQ(result.mean_normal_force, 2.0);
  EXPECT_EQ(result.strong_share, 0.5);
  EXPECT_EQ(result.strong_share_of_mean_stress, 0.75);
  EXPECT_EQ(result.strong_share_of_deviator, 1.5);
  EXPECT_EQ(result.strong_stress_ratio, 1.0);
  EXPECT_EQ(result.weak_stress_ratio, 1.0);
  // All strong contacts are across the bed and all weak ones along it; the amplitude of a single direction is
  // 2.
  EXPECT_EQ(result.network_fabric_amplitude, (std::array<double, 2>{2.0, 2.0}));
  EXPECT_NEAR(result.network_fabric_angle[0], radians(90.0), 1e-12);
  EXPECT_EQ(result.network_fabric_angle[1], 0.0);
}

TEST(Networks, have_together_the_moments_of_the_grains) {
  Packing packing = triangle_with_chain();
  packing.frame.contacts.fn = {1.0, 1.5, 2.5, 2.0, 2.0, 4.0};
  packing.frame.contacts.ft = {0.1, -0.2, 0.3, 0.0, 0.5, -0.5};
  test::moments_from_contacts(packing);
  const Tensor2 whole = stress::sum_of_moments(packing.frame.internal_moment, 0, packing.statics.free_count);
  // If all contacts but one are strong, its share follows from the total.
  const FrameRecord result = found(measure_networks, packing);
  double strong_trace = 0.0;
  for (Index c : {2, 5}) strong_trace += packing.frame.contacts.fn[c] * (c == 5 ? 0.5 : 1.0);
  EXPECT_NEAR(result.strong_share_of_mean_stress, strong_trace / (whole.xx + whole.yy), 1e-12);
}

// Relative to a contact, its moment is (fn, ft; 0, 0) times the branch: P = fn, Q = sqrt(fn^2 + ft^2).
TEST(Networks, count_friction) {
  Packing packing = triangle_with_chain();
  packing.frame.contacts.fn = {1.0, 1.0, 9.0, 1.0, 1.0, 1.0};  // the strong contact is at 120 deg to the bed
  packing.frame.contacts.ft = {0.0, 0.0, 4.5, 0.0, 0.0, 0.0};
  EXPECT_NEAR(found(measure_networks, packing).strong_stress_ratio, std::sqrt(1.25), 1e-12);
}

TEST(CriticalContacts, are_joined_where_they_share_a_grain) {
  Packing packing = triangle_with_chain();
  for (Index c : {0, 4, 5}) packing.frame.contacts.status[c] = ContactStatus::sliding;
  const FrameRecord critical = found(measure_critical_contacts, packing);
  EXPECT_EQ(critical.critical_share, 0.5);
  // left-right and left-floor are connected through the left grain; link-end is separate. Both are pairs at
  // distance 1.
  EXPECT_EQ(critical.critical_clusters, 2);
  EXPECT_EQ(critical.critical_mean, 1.5);
  EXPECT_EQ(critical.critical_weighted_mean, 5.0 / 3.0);
  EXPECT_EQ(critical.critical_largest, 2);
  EXPECT_NEAR(critical.critical_correlation_length, 1.0 / std::sqrt(2.0), 1e-12);
  // Neighbouring contacts without a common contact are not joined: the top grain touches both, with sticking
  // contacts.
  packing.frame.contacts.status[3] = ContactStatus::sliding;
  EXPECT_EQ(found(measure_critical_contacts, packing).critical_largest, 2);
  packing.frame.contacts.status[1] = ContactStatus::sliding;
  EXPECT_EQ(found(measure_critical_contacts, packing).critical_largest, 5);
}

TEST(CriticalContacts, of_a_frame_where_nothing_slides) {
  const Packing packing = triangle_with_chain();
  const FrameRecord critical = found(measure_critical_contacts, packing);
  EXPECT_EQ(critical.critical_share, 0.0);
  EXPECT_EQ(critical.critical_clusters, 0);
  EXPECT_TRUE(std::isnan(critical.critical_mean));
  EXPECT_TRUE(std::isnan(critical.critical_weighted_mean));
  EXPECT_EQ(critical.critical_largest, 0);
  EXPECT_TRUE(std::isnan(critical.critical_correlation_length));
}

}  // namespace
}  // namespace talus::analysis
