/// Stress states, and quantities of a bed.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "core/random.h"
#include "core/trigonometry.h"
#include "core/world.h"
#include "stress/stress.h"
#include "support/scenes.h"
#include "unit/stress/beds.h"

namespace talus::stress {
namespace {

constexpr double r = 0.5;

void expect_tensor(const Tensor2& m, double xx, double xy, double yx, double yy, double tolerance = 1e-14) {
  EXPECT_NEAR(m.xx, xx, tolerance);
  EXPECT_NEAR(m.xy, xy, tolerance);
  EXPECT_NEAR(m.yx, yx, tolerance);
  EXPECT_NEAR(m.yy, yy, tolerance);
}

void add_contact(Contacts& contacts, Index a, Index b, double angle, double fn, double ft = 0.0) {
  const auto c = static_cast<std::size_t>(contacts.count());
  contacts.resize(c + 1);
  contacts.a[c] = a;
  contacts.b[c] = b;
  contacts.nx[c] = std::cos(angle);
  contacts.ny[c] = std::sin(angle);
  contacts.fn[c] = fn;
  contacts.ft[c] = ft;
}

/// Returns one disk of radius r at the origin; contacts are with planes, with ids from 1 on.
Grains one_disk() {
  Grains grains;
  add_disk(grains, {0.0, 0.0}, r, 1.0, false);
  return grains;
}

Tensor2 moment_of_one(const Grains& grains, const Contacts& contacts) {
  std::vector<Tensor2> moments;
  internal_moments(grains, contacts, moments);
  EXPECT_EQ(moments.size(), static_cast<std::size_t>(grains.count()));
  return moments[0];
}

// N at both ends of a diameter: M_yy = 2 r N, compression positive; s2 = 0, so gamma = 1.
TEST(InternalMoment, of_a_disk_pressed_between_two_plates) {
  Contacts contacts;
  add_contact(contacts, 0, 1, 0.5 * pi, 3.0);
  add_contact(contacts, 0, 2, -0.5 * pi, 3.0);
  const Tensor2 m = moment_of_one(one_disk(), contacts);
  expect_tensor(m, 0.0, 0.0, 0.0, 2.0 * r * 3.0);
  EXPECT_NEAR(stress_state(m).ratio, 1.0, 1e-14);
}

// f_t = T on the right and left turns the disk one way, and -T above and below the other way. At (r, 0) the
// force on the disk is -T along y: this side and the left one each add r T to M_xy, and those above and below
// add the same to M_yx.
TEST(InternalMoment, of_a_sheared_disk_is_symmetric) {
  Contacts contacts;
  for (int k = 0; k < 4; ++k) add_contact(contacts, 0, 1 + k, 0.5 * pi * k, 3.0, k % 2 == 0 ? 1.0 : -1.0);
  const Tensor2 m = moment_of_one(one_disk(), contacts);
  expect_tensor(m, 2.0 * r * 3.0, 2.0 * r * 1.0, 2.0 * r * 1.0, 2.0 * r * 3.0);
}

// xy - yx is the unbalanced torque: one contact with f_t = T turns the disk with -r T.
TEST(InternalMoment, its_asymmetry_is_the_unbalanced_torque) {
  for (double angle : {0.0, 1.0, 2.5, -2.0}) {
    Contacts contacts;
    add_contact(contacts, 0, 1, angle, 3.0, 2.0);
    const Tensor2 m = moment_of_one(one_disk(), contacts);
    EXPECT_NEAR(m.xy - m.yx, r * 2.0, 1e-14);
  }
}

TEST(InternalMoment, rotation_counts_as_tension) {
  Grains grains = one_disk();
  grains.omega[0] = 4.0;
  const double term = -0.5 * (0.5 * pi * r * r * r * r) * 16.0;
  expect_tensor(moment_of_one(grains, {}), term, 0.0, 0.0, term, 1e-13);
}

// Both sides of a contact have the same moment n (x) f, because n and f change sign together.
TEST(InternalMoment, a_contact_gives_each_of_its_grains_its_share) {
  Grains grains = one_disk();
  add_disk(grains, {0.0, 1.5}, 1.0, 1.0, false);
  Contacts contacts;
  add_contact(contacts, 0, 1, 0.5 * pi, 3.0, 0.5);  // f on 1 = (-0.5, 3)
  std::vector<Tensor2> moments;
  internal_moments(grains, contacts, moments);
  expect_tensor(moments[0], 0.0, 0.0, r * -0.5, r * 3.0);
  expect_tensor(moments[1], 0.0, 0.0, -0.5, 3.0);
}

/// Touching disks on a triangular lattice with random forces at all contacts; the outermost touch planes.
struct RandomLattice {
  Grains grains;
  Contacts contacts;

  explicit RandomLattice(std::uint64_t seed) {
    Random random(seed);
    for (Index row = 0; row < 6; ++row)
      for (Index column = 0; column < 6; ++column)
        add_disk(grains, {(column + 0.5 * row) * 2.0 * r, row * std::sqrt(3.0) * r}, r, 1.0, false);
    for (Index a = 0; a < grains.count(); ++a) {
      for (Index b = a + 1; b < grains.count(); ++b) {
        const double dx = grains.x[b] - grains.x[a];
        const double dy = grains.y[b] - grains.y[a];
        if (dx * dx + dy * dy < 4.01 * r * r)
          add_contact(contacts, a, b, std::atan2(dy, dx), random.uniform(), random.uniform(-0.5, 0.5));
      }
      if (a < 6)
        add_contact(contacts, a, grains.count(), -0.5 * pi, random.uniform(), random.uniform(-0.5, 0.5));
    }
  }
};

// The sum of M over a set equals - sum over outer contacts of r_i f_j + sum over grains of r_i F_j, with r
// from any origin and F all contact forces on a grain: inner contacts act at one point on both sides and
// cancel. This holds for balanced and unbalanced forces; at rest F = -m g.
TEST(InternalMoment, adds_up_to_the_moment_of_the_outer_forces) {
  const RandomLattice lattice(1);
  const Grains& g = lattice.grains;
  const Contacts& c = lattice.contacts;
  const Vec2 origin{3.0, -7.0};
  Tensor2 expected;
  const auto add = [&](double x, double y, double fx, double fy) {
    expected.xx += (x - origin.x) * fx;
    expected.xy += (x - origin.x) * fy;
    expected.yx += (y - origin.y) * fx;
    expected.yy += (y - origin.y) * fy;
  };
  for (Index k = 0; k < c.count(); ++k) {
    const Index a = c.a[k];
    const Index b = c.b[k];
    const double fx = c.fn[k] * c.nx[k] - c.ft[k] * c.ny[k];
    const double fy = c.fn[k] * c.ny[k] + c.ft[k] * c.nx[k];
    add(g.x[a], g.y[a], -fx, -fy);
    if (b < g.count())
      add(g.x[b], g.y[b], fx, fy);
    else
      add(g.x[a] + r * c.nx[k], g.y[a] + r * c.ny[k], fx, fy);
  }
  std::vector<Tensor2> moments;
  internal_moments(g, c, moments);
  const Tensor2 sum = sum_of_moments(moments, 0, g.count());
  expect_tensor(sum, expected.xx, expected.xy, expected.yx, expected.yy, 1e-11);
}

TEST(InternalMoment, used_arrays_are_written_anew) {
  std::vector<Tensor2> moments(50, Tensor2{1.0, 1.0, 1.0, 1.0});
  internal_moments(one_disk(), {}, moments);
  ASSERT_EQ(moments.size(), 1u);
  expect_tensor(moments[0], 0.0, 0.0, 0.0, 0.0);
}

/// Returns a tensor with principal values s1, s2 and the major direction at `angle` to x.
Tensor2 tensor_of(double s1, double s2, double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {s1 * c * c + s2 * s * s, (s1 - s2) * c * s, (s1 - s2) * c * s, s1 * s * s + s2 * c * c};
}

TEST(StressState, has_the_principal_values_and_the_direction) {
  for (double angle : {-1.5, -0.7, 0.0, 0.4, 1.2, 1.57}) {
    const StressState state = stress_state(tensor_of(5.0, 3.0, angle));
    EXPECT_NEAR(state.mean, 8.0, 1e-14);
    EXPECT_NEAR(state.deviator, 2.0, 1e-14);
    EXPECT_NEAR(state.ratio, 0.25, 1e-14);
    EXPECT_NEAR(state.axis, angle, 1e-14);
  }
}

TEST(StressState, sees_the_symmetric_part_alone) {
  Tensor2 tensor = tensor_of(5.0, 3.0, 0.4);
  tensor.xy += 7.0;
  tensor.yx -= 7.0;
  EXPECT_NEAR(stress_state(tensor).deviator, 2.0, 1e-14);
  EXPECT_NEAR(stress_state(tensor).axis, 0.4, 1e-14);
}

TEST(StressState, the_ratio_is_between_zero_and_one_in_compression) {
  EXPECT_EQ(stress_state({2.0, 0.0, 0.0, 2.0}).ratio, 0.0);
  EXPECT_EQ(stress_state({0.0, 0.0, 0.0, 2.0}).ratio, 1.0);
}

// s1 = 3, s2 = -1, as in a grain under transverse tension (docs/notation.md, gamma).
TEST(StressState, the_ratio_is_above_one_where_one_principal_value_is_a_tension) {
  EXPECT_NEAR(stress_state(tensor_of(3.0, -1.0, 0.4)).ratio, 2.0, 1e-14);
}

TEST(StressState, has_no_ratio_without_compression) {
  EXPECT_TRUE(std::isnan(stress_state({}).ratio));
  EXPECT_TRUE(std::isnan(stress_state({-1.0, 0.0, 0.0, -1.0}).ratio));
  EXPECT_TRUE(std::isnan(stress_state({1.0, 0.0, 0.0, -1.0}).ratio));
}

TEST(Overload, begins_at_the_threshold_and_leaves_out_grains_that_carry_nothing) {
  EXPECT_TRUE(is_overloaded(0.35, 0.35));
  EXPECT_TRUE(is_overloaded(0.36, 0.35));
  EXPECT_FALSE(is_overloaded(0.34, 0.35));
  EXPECT_FALSE(is_overloaded(std::numeric_limits<double>::quiet_NaN(), 0.35));
}

using test::add_grain;
using test::empty_bed;

TEST(Bed, area_and_height_are_those_of_the_free_grains) {
  World world = empty_bed(10.0, true);
  add_grain(world, 1.0, 1.0, 1.0);
  add_grain(world, 4.0, 6.0, 2.0);
  add_grain(world, 7.0, 100.0, 3.0, true);
  EXPECT_DOUBLE_EQ(solid_area(world.grains), 5.0 * pi);
  EXPECT_DOUBLE_EQ(centre_of_mass_height(world.grains), (1.0 * 1.0 + 4.0 * 6.0) / 5.0);
  EXPECT_EQ(centre_of_mass_height({}), 0.0);
}

TEST(ContactStatus, tells_open_sticking_and_sliding_apart) {
  EXPECT_EQ(contact_status(0.0, 0.0, 0.5), ContactStatus::open);
  EXPECT_EQ(contact_status(2.0, 0.9, 0.5), ContactStatus::sticking);
  EXPECT_EQ(contact_status(2.0, 1.0, 0.5), ContactStatus::sliding);
  EXPECT_EQ(contact_status(2.0, -1.0, 0.5), ContactStatus::sliding);
  EXPECT_EQ(contact_status(2.0, 0.0, 0.0), ContactStatus::sliding);  // no friction remains to be mobilised
}

TEST(ContactStatus, sliding_is_judged_within_the_tolerance) {
  EXPECT_EQ(contact_status(2.0, 1.0 - 1.9e-6, 0.5), ContactStatus::sliding);
  EXPECT_EQ(contact_status(2.0, 1.0 - 2.1e-6, 0.5), ContactStatus::sticking);
  EXPECT_EQ(contact_status(2.0, 0.95, 0.5, 0.03), ContactStatus::sliding);
}

// Grains 0, 1, 2 are free, 3 is a rattler, 4 is glued, 5 is a plane. Ends at free grains: 0-1 has two, 1-4
// and 2-5 have one each.
TEST(CoordinationNumber, counts_each_contact_for_each_free_grain_it_touches) {
  const std::vector<Index> a = {0, 1, 2}, b = {1, 4, 5};
  EXPECT_EQ(contacts_of_grains(a, b, 4), (std::vector<Index>{1, 2, 1, 0}));
  EXPECT_DOUBLE_EQ(coordination_number(contacts_of_grains(a, b, 4)), 4.0 / 3.0);
  EXPECT_EQ(coordination_number(contacts_of_grains({}, {}, 4)), 0.0);
}

}  // namespace
}  // namespace talus::stress
