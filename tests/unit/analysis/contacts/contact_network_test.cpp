/// Contact networks, and their weak contacts.

#include "analysis/contacts/contact_network.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/errors.h"
#include "core/trigonometry.h"
#include "stress/stress.h"
#include "unit/analysis/packings.h"

namespace talus::analysis {
namespace {

using test::add_contact, test::add_grain, test::empty_packing, test::Packing;

/// Returns the result of one of the functions for a packing.
FrameRecord found(void (*take)(const BedFrame&, FrameRecord&), const Packing& packing) {
  FrameRecord record;
  take(packing, record);
  return record;
}

/// Returns a triangle on the floor with an attached chain of two grains, and a grain without contacts.
Packing triangle_with_chain() {
  Packing packing = empty_packing(10.0, false);
  const Index left = add_grain(packing, 2.0, 0.5);
  const Index right = add_grain(packing, 3.0, 0.5);
  const Index top = add_grain(packing, 2.5, 0.5 + std::sqrt(0.75));
  const Index link = add_grain(packing, 3.5, 0.5 + std::sqrt(0.75));
  const Index end = add_grain(packing, 4.5, 0.5 + std::sqrt(0.75));
  add_grain(packing, 8.0, 0.5);
  const Index floor = test::add_floor_grain(packing, 2.0, -0.5);
  add_contact(packing, left, right, 1.0);
  add_contact(packing, left, top, 1.0);
  add_contact(packing, right, top, 1.0);
  add_contact(packing, top, link, 1.0);
  add_contact(packing, link, end, 1.0);
  add_contact(packing, left, floor, 1.0);
  return packing;
}

TEST(Coordination, counts_ends_at_free_grains) {
  const FrameRecord z = found(measure_coordination, triangle_with_chain());
  EXPECT_EQ(z.coordination_number, 11.0 / 5.0);
  EXPECT_EQ(z.coordination_number_of_all, 11.0 / 6.0);
}

// The end of the chain has one contact; without it, the next grain has one. The triangle keeps 3 * 2 + 1
// ends.
TEST(Coordination, without_rattlers_takes_them_away_again_and_again) {
  const FrameRecord z = found(measure_coordination, triangle_with_chain());
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
  Packing packing = empty_packing(10.0, false);
  for (const auto& [x, y] : {std::pair{5.0, 5.0}, {6.0, 5.0}, {4.0, 5.0}, {5.0, 6.0}, {5.0, 4.0}})
    add_grain(packing, x, y);
  for (Index i : {1, 2}) add_contact(packing, 0, i, weak);
  for (Index i : {3, 4}) add_contact(packing, 0, i, strong);
  return packing;
}

// Moments: strong 2 fn along y, weak 2 fn along x. Q of both is 2 (3 - 1), of which strong contacts give 3/2
// and weak ones -1/2.
TEST(Networks, share_the_stress) {
  const FrameRecord result = found(measure_networks, cross(3.0, 1.0));
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
  const FrameRecord critical = found(measure_critical_contacts, triangle_with_chain());
  EXPECT_EQ(critical.critical_share, 0.0);
  EXPECT_EQ(critical.critical_clusters, 0);
  EXPECT_TRUE(std::isnan(critical.critical_mean));
  EXPECT_TRUE(std::isnan(critical.critical_weighted_mean));
  EXPECT_EQ(critical.critical_largest, 0);
  EXPECT_TRUE(std::isnan(critical.critical_correlation_length));
}

/// Grain 0 in the middle, with contacts in the given directions (deg), each with a different grain.
struct Star {
  Packing packing = empty_packing(100.0, false);

  Star() { add_grain(packing, 0.0, 0.0); }

  void add(double direction, double fn, double mobilised) {
    const Index tip = add_grain(packing, cosine(radians(direction)), sine(radians(direction)));
    add_contact(packing, 0, tip, fn, mobilised * 0.5 * fn);
  }
};

// Returns a star with two strong contacts at 0 deg; the mean force is 2.5.
Star chain() {
  Star star;
  star.add(0.0, 5.0, 0.1);
  star.add(0.0, 5.0, 0.9);
  return star;
}

FrameRecord weak_contacts(const Packing& packing, double mean_normal_force) {
  FrameRecord record;
  record.mean_normal_force = mean_normal_force;
  measure_weak_contacts(packing, std::vector{0.0, 0.5, 1.0}, record);
  return record;
}

TEST(WeakContacts, coherent_ones_across_the_chains_have_negative_fabric) {
  Star star = chain();
  star.add(90.0, 1.0, 0.9);
  star.add(90.0, 1.0, 1.0);
  star.add(45.0, 1.0, 0.1);
  star.add(0.0, 1.0, 0.1);
  const FrameRecord weak = weak_contacts(star.packing, 2.5);
  EXPECT_DOUBLE_EQ(weak.coherent_share, 2.0 / 6.0);
  EXPECT_NEAR(weak.coherent_fabric, -2.0, 1e-15);
  EXPECT_NEAR(weak.incoherent_fabric, 1.0, 1e-15);
  ASSERT_EQ(weak.weak_fabric_by_friction.size(), 2U);
  EXPECT_NEAR(weak.weak_fabric_by_friction[0], 1.0, 1e-15);
  EXPECT_NEAR(weak.weak_fabric_by_friction[1], -2.0, 1e-15);
}

TEST(WeakContacts, friction_counts_without_its_sign_and_from_the_threshold_on) {
  Star star = chain();
  star.add(90.0, 1.0, -0.8);
  star.add(90.0, 1.0, 0.79);
  EXPECT_DOUBLE_EQ(weak_contacts(star.packing, 2.5).coherent_share, 1.0 / 4.0);
}

TEST(WeakContacts, fabric_is_relative_to_the_strong_contacts) {
  Star star;
  star.add(30.0, 5.0, 0.0);
  star.add(-60.0, 1.0, 1.0);
  star.add(75.0, 1.0, 0.0);
  const FrameRecord weak = weak_contacts(star.packing, 2.0);
  EXPECT_NEAR(weak.coherent_fabric, -2.0, 1e-14);
  EXPECT_NEAR(weak.incoherent_fabric, 0.0, 1e-14);
}

TEST(WeakContacts, what_rounding_leaves_above_full_mobilisation_is_in_the_last_bin) {
  Star star = chain();
  star.add(90.0, 1.0, 1.0 + 1e-12);
  EXPECT_NEAR(weak_contacts(star.packing, 2.5).weak_fabric_by_friction[1], -2.0, 1e-15);
}

TEST(WeakContacts, nothing_is_known_without_contacts) {
  const Star star;
  const FrameRecord weak = weak_contacts(star.packing, not_known);
  EXPECT_TRUE(std::isnan(weak.coherent_share));
  EXPECT_TRUE(std::isnan(weak.coherent_fabric));
  EXPECT_TRUE(std::isnan(weak.weak_fabric_by_friction[0]));
}

using Indices = std::vector<Index>;

/// Returns three grains in a row, at 0.5, 1.5, 2.5, without contacts; images 0.
Packing three_grains() {
  Packing packing = empty_packing(10.0, true);
  for (const double x : {0.5, 1.5, 2.5}) add_grain(packing, x, 0.5);
  packing.frame.image.assign(3, 0);
  return packing;
}

TEST(ContactChanges, report_changes) {
  Packing before = three_grains(), after = three_grains();
  add_contact(before, 0, 1, 1.0);
  add_contact(before, 1, 2, 1.0);
  add_contact(after, 0, 2, 2.0);
  add_contact(after, 1, 2, 5.0, 2.5);  // force and status do not matter
  const ContactChanges changes = contact_changes(before.frame, after.frame);
  EXPECT_EQ(changes.gained, (Indices{0}));
  EXPECT_EQ(changes.lost, (Indices{0}));
  const ContactChanges back = contact_changes(after.frame, before.frame);
  EXPECT_EQ(back.gained, (Indices{0}));
  EXPECT_EQ(back.lost, (Indices{0}));
}

TEST(ContactChanges, of_a_frame_and_itself_are_none) {
  Packing packing = three_grains();
  add_contact(packing, 0, 1, 1.0);
  add_contact(packing, 0, 2, 1.0, 0.0, -1);
  const ContactChanges changes = contact_changes(packing.frame, packing.frame);
  EXPECT_TRUE(changes.gained.empty());
  EXPECT_TRUE(changes.lost.empty());
}

TEST(ContactChanges, a_pair_that_goes_through_the_edge_keeps_its_contact) {
  Packing before = three_grains(), after = three_grains();
  add_contact(before, 0, 1, 1.0);
  // Grain 0 has left on the left and re-entered on the right: seen from it, grain 1 is one period farther.
  after.frame.x[0] = 9.5;
  after.frame.image[0] = -1;
  add_contact(after, 0, 1, 1.0, 0.0, 1);
  EXPECT_TRUE(contact_changes(before.frame, after.frame).gained.empty());
  EXPECT_TRUE(contact_changes(before.frame, after.frame).lost.empty());
  // Now grain 1 has done so too.
  after.frame.x[1] = 9.9;
  after.frame.image[1] = -1;
  after.frame.contacts.shift[0] = 0;
  EXPECT_TRUE(contact_changes(before.frame, after.frame).gained.empty());
}

TEST(ContactChanges, another_image_of_a_grain_is_another_neighbour) {
  Packing before = three_grains(), after = three_grains();
  add_contact(before, 0, 1, 1.0);
  add_contact(after, 0, 1, 1.0, 0.0, -1);
  EXPECT_EQ(contact_changes(before.frame, after.frame).gained, (Indices{0}));
  EXPECT_EQ(contact_changes(before.frame, after.frame).lost, (Indices{0}));
}

TEST(ContactChanges, a_smooth_floor_is_one_body_in_all_periods) {
  Packing before = three_grains(), after = three_grains();
  add_contact(before, 0, 1, 1.0);
  add_contact(after, 0, 1, 1.0);
  for (Packing* packing : {&before, &after}) packing->frame.contacts.b[0] = 3;  // a plane
  after.frame.image[0] = 1;
  EXPECT_TRUE(contact_changes(before.frame, after.frame).gained.empty());
}

TEST(ContactChanges, are_between_frames_of_the_same_grains) {
  Packing more = three_grains();
  add_grain(more, 5.0, 0.5);
  EXPECT_THROW(contact_changes(three_grains().frame, more.frame), Error);
}

}  // namespace
}  // namespace talus::analysis
