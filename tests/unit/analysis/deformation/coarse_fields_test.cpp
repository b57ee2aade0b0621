#include "analysis/deformation/coarse_fields.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/random.h"
#include "core/trigonometry.h"
#include "unit/analysis/packings.h"

namespace talus::analysis {
namespace {

using test::Packing;

constexpr double cutoff = 2.0;

void complete(Packing& packing) {
  packing.statics.mass.clear();
  for (const double radius : packing.statics.radius) packing.statics.mass.push_back(3.0 * radius * radius);
  packing.frame.vx.assign(packing.frame.x.size(), 0.0);
  packing.frame.vy.assign(packing.frame.x.size(), 0.0);
}

void touch_left_wall(Packing& packing, std::initializer_list<Index> grains) {
  FrameContacts& contacts = packing.frame.contacts;
  for (const Index i : grains) {
    contacts.a.push_back(i);
    contacts.b.push_back(packing.frame.grain_count());
    contacts.shift.push_back(0);
    contacts.nx.push_back(-1.0);
    contacts.ny.push_back(0.0);
    contacts.px.push_back(packing.frame.x[i] - packing.statics.radius[i]);
    contacts.py.push_back(packing.frame.y[i]);
    contacts.fn.push_back(1.5);
    contacts.ft.push_back(0.2);
    contacts.status.push_back(ContactStatus::sticking);
  }
}

/// Adds contacts with random forces between free grains, and between these and other bodies, closer than
/// `reach`.
void touch(Packing& packing, double reach, Random& random) {
  const bool periodic = packing.statics.periodic;
  for (Index a = 0; a < 60; ++a)
    for (Index b = a + 1; b < packing.frame.grain_count(); ++b) {
      const double dx = packing.frame.x[b] - packing.frame.x[a];
      const int shift = !periodic ? 0 : dx > 5.0 ? -1 : dx < -5.0 ? 1 : 0;
      if (std::hypot(dx + shift * 10.0, packing.frame.y[b] - packing.frame.y[a]) < reach)
        test::add_contact(packing, a, b, random.uniform(0.1, 2.0), random.uniform(-0.5, 0.5), shift);
    }
}

/// Returns a lattice of 60 grains on a floor of ten, in which all neighbours touch.
Packing lattice_bed(bool periodic) {
  Packing packing = test::triangular_lattice(10, 6, periodic);
  for (int k = 0; k < 10; ++k) test::add_floor_grain(packing, k + 0.75, 0.5 - std::sqrt(0.75));
  complete(packing);
  Random random(29);
  touch(packing, 1.001, random);
  if (!periodic) touch_left_wall(packing, {0, 20, 40});
  return packing;
}

/// Returns 60 grains above a floor of ten, with random contacts and velocities; between walls, also contacts
/// with the walls.
Packing random_bed(bool periodic) {
  Packing packing = test::random_packing(3, 60, 10.0, 6.0, periodic);
  for (int k = 0; k < 10; ++k) test::add_floor_grain(packing, k + 0.5, -0.5);
  complete(packing);
  Random random(17);
  for (Index i = 0; i < 60; ++i) {
    packing.frame.vx[i] = random.uniform(-1.0, 1.0);
    packing.frame.vy[i] = random.uniform(-1.0, 1.0);
  }
  touch(packing, 1.0, random);
  if (!periodic) touch_left_wall(packing, {3, 8, 20});
  return packing;
}

/// Returns the integral of a field over the plane, for a bed of length 10; over one period if the bed is
/// periodic.
double integral(bool periodic, const std::function<double(double, double)>& value) {
  constexpr double spacing = 0.1;
  const double margin = periodic ? 0.0 : 3.0;
  double sum = 0.0;
  for (double x = -margin + 0.5 * spacing; x < 10.0 + margin; x += spacing)
    for (double y = -4.0 + 0.5 * spacing; y < 10.0; y += spacing) sum += value(x, y);
  return sum * spacing * spacing;
}

TEST(CoarseFields, lucy_function_has_an_integral_of_one_and_ends_smoothly) {
  double sum = 0.0;
  for (int k = 0; k < 2000; ++k) {
    const double r = cutoff * (k + 0.5) / 2000.0;
    sum += 2.0 * pi * r * lucy_function(r, cutoff) * cutoff / 2000.0;
  }
  EXPECT_NEAR(sum, 1.0, 1e-6);
  EXPECT_EQ(lucy_function(cutoff, cutoff), 0.0);
  EXPECT_LT(lucy_function(0.999 * cutoff, cutoff), 1e-8);
}

TEST(CoarseFields, sum_up_to_the_packings_own_values) {
  for (const bool periodic : {true, false}) {
    Packing packing = random_bed(periodic);
    test::moments_from_contacts(packing);
    double mass = 0.0, momentum = 0.0, flux = 0.0;
    Tensor2 moment;
    for (std::size_t i = 0; i < 60; ++i) {
      mass += packing.statics.mass[i];
      momentum += packing.statics.mass[i] * packing.frame.vx[i];
      flux += packing.statics.mass[i] * packing.frame.vx[i] * packing.frame.vy[i];
      matrix(moment) += matrix(packing.frame.internal_moment[i]);
    }
    const CoarseFields fields(packing, cutoff);
    const auto sum = [&](auto value) {
      return integral(periodic, [&](double x, double y) { return value(fields.at(x, y)); });
    };
    EXPECT_NEAR(sum([](const CoarseField& at) { return at.density; }), mass, 1e-3 * mass);
    EXPECT_NEAR(sum([](const CoarseField& at) { return at.momentum.x; }), momentum, 1e-3 * mass);
    const double size = std::fabs(moment.xx) + std::fabs(moment.yy);
    EXPECT_NEAR(sum([](const CoarseField& at) { return at.contact_stress.xx; }), moment.xx, 1e-3 * size);
    EXPECT_NEAR(sum([](const CoarseField& at) { return at.contact_stress.xy; }), moment.xy, 1e-3 * size);
    EXPECT_NEAR(sum([](const CoarseField& at) { return at.contact_stress.yx; }), moment.yx, 1e-3 * size);
    EXPECT_NEAR(sum([](const CoarseField& at) { return at.contact_stress.yy; }), moment.yy, 1e-3 * size);
    EXPECT_NEAR(sum([](const CoarseField& at) {
                  return at.density > 0.0 ? at.kinetic_stress.xy + at.momentum.x * at.momentum.y / at.density
                                          : 0.0;
                }),
                flux, 1e-3 * mass);
  }
}

// With W(r - r_i) for each grain and each boundary contact, momentum is balanced everywhere up to walls and
// floor: the divergence of the stress equals the net forces on grains minus the forces of the boundaries.
TEST(CoarseFields, balance_momentum_up_to_the_boundaries) {
  for (const bool periodic : {true, false}) {
    const Packing packing = lattice_bed(periodic);
    std::vector<Vector2> net(60, Vector2::Zero());
    const FrameContacts& contacts = packing.frame.contacts;
    for (Index c = 0; c < contacts.count(); ++c) {
      const Vector2 n(contacts.nx[c], contacts.ny[c]), t(-n.y(), n.x());
      const Vector2 force = contacts.fn[c] * n + contacts.ft[c] * t;
      net[contacts.a[c]] -= force;
      if (contacts.b[c] < 60) net[contacts.b[c]] += force;
    }
    const CoarseFields fields(packing, cutoff);
    const double h = 1e-3;
    for (const auto& [x, y] : {std::pair(0.4, 0.3), {2.3, -0.4}, {5.0, 3.0}, {9.7, 5.0}, {-0.5, 2.0}}) {
      const auto stress = [&](double at_x, double at_y) { return fields.at(at_x, at_y).contact_stress; };
      const Tensor2 right = stress(x + h, y), left = stress(x - h, y), up = stress(x, y + h),
                    down = stress(x, y - h);
      const Vector2 divergence((right.xx - left.xx + up.yx - down.yx) / (2.0 * h),
                               (right.xy - left.xy + up.yy - down.yy) / (2.0 * h));
      Vector2 expected(fields.at(x, y).boundary_force.x, fields.at(x, y).boundary_force.y);
      for (std::size_t i = 0; i < 60; ++i) {
        double dx = packing.frame.x[i] - x;
        if (periodic) dx -= 10.0 * std::round(dx / 10.0);
        expected -= net[i] * lucy_function(std::hypot(dx, packing.frame.y[i] - y), cutoff);
      }
      EXPECT_NEAR(divergence.x(), expected.x(), 5e-3) << x << " " << y;
      EXPECT_NEAR(divergence.y(), expected.y(), 5e-3) << x << " " << y;
    }
  }
}

/// Returns grains at random places with v = v0 + G r.
Packing sheared_bed(const Tensor2& gradient) {
  Packing packing = test::random_packing(9, 400, 20.0, 16.0, false);
  complete(packing);
  for (std::size_t i = 0; i < packing.frame.x.size(); ++i) {
    packing.frame.vx[i] = 0.7 + gradient.xx * packing.frame.x[i] + gradient.xy * packing.frame.y[i];
    packing.frame.vy[i] = -0.2 + gradient.yx * packing.frame.x[i] + gradient.yy * packing.frame.y[i];
  }
  return packing;
}

TEST(CoarseFields, uniform_flow_has_its_velocity_and_neither_shear_nor_fluctuations) {
  const CoarseField field = CoarseFields(sheared_bed({}), cutoff).at(9.0, 8.0);
  EXPECT_NEAR(field.velocity().x, 0.7, 1e-12);
  EXPECT_NEAR(field.velocity().y, -0.2, 1e-12);
  EXPECT_NEAR(shear_rate(field.velocity_gradient), 0.0, 1e-12);
  EXPECT_NEAR(field.kinetic_stress.xx, 0.0, 1e-12);
  EXPECT_NEAR(field.temperature, 0.0, 1e-12);
}

TEST(CoarseFields, uniform_shear_has_its_rate_and_no_temperature) {
  const Packing packing = sheared_bed({0.0, 0.4, 0.0, 0.0});
  const CoarseFields fields(packing, 4.0);
  double rate = 0.0;
  for (int k = 0; k < 9; ++k) {
    const CoarseField field = fields.at(6.0 + 4.0 * (k % 3), 5.0 + 3.0 * (k / 3));
    rate += shear_rate(field.velocity_gradient) / 9.0;
    EXPECT_NEAR(field.temperature, 0.0, 1e-12);
    EXPECT_GT(field.kinetic_stress.xx, 0.01) << "which grows with the square of the width";
  }
  EXPECT_NEAR(rate, 0.4, 0.04);
  for (const double temperature : granular_temperatures(packing, 4.0)) EXPECT_NEAR(temperature, 0.0, 1e-12);
}

TEST(CoarseFields, gradient_is_that_of_their_own_velocity) {
  const CoarseFields fields(random_bed(true), cutoff);
  const double h = 1e-5;
  const auto velocity = [&](double x, double y) { return fields.at(x, y).velocity(); };
  const Tensor2 gradient = fields.at(4.0, 3.0).velocity_gradient;
  EXPECT_NEAR(gradient.xx, (velocity(4.0 + h, 3.0).x - velocity(4.0 - h, 3.0).x) / (2.0 * h), 1e-6);
  EXPECT_NEAR(gradient.xy, (velocity(4.0, 3.0 + h).x - velocity(4.0, 3.0 - h).x) / (2.0 * h), 1e-6);
  EXPECT_NEAR(gradient.yx, (velocity(4.0 + h, 3.0).y - velocity(4.0 - h, 3.0).y) / (2.0 * h), 1e-6);
}

// The estimate from few grains agrees on average with that from many: the fit removes no part of it.
TEST(CoarseFields, temperature_is_that_of_independent_velocities) {
  constexpr double deviation = 0.3;
  Packing packing = sheared_bed({0.1, 0.4, -0.3, 0.2});
  Random random(23);
  for (std::size_t i = 0; i < packing.frame.x.size(); ++i) {
    packing.frame.vx[i] += random.uniform(-1.0, 1.0) * deviation * std::sqrt(3.0);
    packing.frame.vy[i] += random.uniform(-1.0, 1.0) * deviation * std::sqrt(3.0);
  }
  FrameRecord record;
  measure_granular_temperature(packing, record);
  EXPECT_NEAR(record.granular_temperature, deviation * deviation, 0.06 * deviation * deviation);
}

TEST(CoarseFields, are_empty_where_no_grain_is_near) {
  const CoarseField field = CoarseFields(random_bed(false), cutoff).at(5.0, 30.0);
  EXPECT_EQ(field.density, 0.0);
  EXPECT_EQ(field.stress().yy, 0.0);
  EXPECT_TRUE(std::isnan(field.temperature));
  EXPECT_TRUE(std::isnan(field.velocity().x));
  const CoarseField nothing = CoarseFields(test::empty_packing(10.0, false), cutoff).at(5.0, 3.0);
  EXPECT_EQ(nothing.density, 0.0);
}

}  // namespace
}  // namespace talus::analysis
