#include "stress/internal_moment.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "core/trigonometry.h"
#include "core/world.h"
#include "stress/stress_state.h"
#include "support/scenes.h"

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

TEST(InternalMoment, of_a_disk_pressed_from_all_sides_is_isotropic) {
  for (int count : {4, 6}) {
    Contacts contacts;
    for (int k = 0; k < count; ++k) add_contact(contacts, 0, 1 + k, 0.3 + 2.0 * pi * k / count, 3.0);
    const Tensor2 m = moment_of_one(one_disk(), contacts);
    expect_tensor(m, 0.5 * count * r * 3.0, 0.0, 0.0, 0.5 * count * r * 3.0);
    EXPECT_NEAR(stress_state(m).ratio, 0.0, 1e-14);
  }
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

TEST(InternalMoment, of_parts_adds_to_that_of_the_whole) {
  const RandomLattice lattice(2);
  std::vector<Tensor2> moments;
  internal_moments(lattice.grains, lattice.contacts, moments);
  const Index count = lattice.grains.count();
  const Tensor2 lower = sum_of_moments(moments, 0, 20);
  const Tensor2 upper = sum_of_moments(moments, 20, count);
  const Tensor2 whole = sum_of_moments(moments, 0, count);
  expect_tensor(whole, lower.xx + upper.xx, lower.xy + upper.xy, lower.yx + upper.yx, lower.yy + upper.yy,
                1e-13);
  expect_tensor(sum_of_moments(moments, 5, 5), 0.0, 0.0, 0.0, 0.0);
}

TEST(InternalMoment, used_arrays_are_written_anew) {
  std::vector<Tensor2> moments(50, Tensor2{1.0, 1.0, 1.0, 1.0});
  internal_moments(one_disk(), {}, moments);
  ASSERT_EQ(moments.size(), 1u);
  expect_tensor(moments[0], 0.0, 0.0, 0.0, 0.0);
}

}  // namespace
}  // namespace talus::stress
