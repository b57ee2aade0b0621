///

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "analysis/deformation/deformation.h"
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
  if (periodic) return packing;
  for (const Index i : {0, 20, 40}) test::add_left_wall_contact(packing, i, 1.5, 0.2);
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
  if (periodic) return packing;
  for (const Index i : {3, 8, 20}) test::add_left_wall_contact(packing, i, 1.5, 0.2);
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
  EXPECT_NEAR(shear_strain(field.velocity_gradient), 0.0, 1e-12);
  EXPECT_NEAR(field.kinetic_stress.xx, 0.0, 1e-12);
  EXPECT_NEAR(field.temperature, 0.0, 1e-12);
}

TEST(CoarseFields, uniform_shear_has_its_rate_and_no_temperature) {
  const Packing packing = sheared_bed({0.0, 0.4, 0.0, 0.0});
  const CoarseFields fields(packing, 4.0);
  double rate = 0.0;
  for (int k = 0; k < 9; ++k) {
    const CoarseField field = fields.at(6.0 + 4.0 * (k % 3), 5.0 + 3.0 * (k / 3));
    rate += shear_strain(field.velocity_gradient) / 9.0;
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

/// Adds images, which packings omit.
Packing with_images(Packing packing) {
  packing.frame.image.assign(packing.frame.x.size(), 0);
  return packing;
}

/// Returns the frame with each grain moved from r to F r + shift.
Frame moved_by(const Frame& before, const Tensor2& f, double shift_x = 0.0, double shift_y = 0.0) {
  Frame now = before;
  for (std::size_t i = 0; i < before.x.size(); ++i) {
    now.x[i] = f.xx * before.x[i] + f.xy * before.y[i] + shift_x;
    now.y[i] = f.yx * before.x[i] + f.yy * before.y[i] + shift_y;
  }
  return now;
}

Packing random_bed() { return with_images(test::random_packing(5, 150, 12.0, 10.0, false)); }

TEST(LocalDeformation, of_an_affine_motion_is_its_gradient_and_leaves_nothing) {
  const Packing bed = random_bed();
  const Frame now = moved_by(bed.frame, {1.1, 0.3, -0.2, 0.9}, 3.0, -1.0);
  for (const LocalDeformation& deformation : local_deformations(bed.frame, {now, bed.statics})) {
    const auto [xx, xy, yx, yy] = deformation.gradient;
    EXPECT_LT(std::hypot(xx - 0.1, xy - 0.3, std::hypot(yx + 0.2, yy + 0.1)), 1e-12);
    EXPECT_NEAR(deformation.nonaffine, 0.0, 1e-13);
  }
}

TEST(LocalDeformation, of_a_rigid_turn_is_vorticity_without_strain) {
  const Packing bed = random_bed();
  const double angle = radians(40.0), c = std::cos(angle), s = std::sin(angle);
  const Frame now = moved_by(bed.frame, {c, -s, s, c}, 1.0, 2.0);
  for (const LocalDeformation& deformation : local_deformations(bed.frame, {now, bed.statics})) {
    EXPECT_NEAR(shear_strain(deformation.gradient), 0.0, 1e-12);
    EXPECT_NEAR(area_strain(deformation.gradient), 0.0, 1e-12);
    EXPECT_NEAR(vorticity(deformation.gradient), 2.0 * angle, 1e-12);
    EXPECT_NEAR(deformation.nonaffine, 0.0, 1e-12);
  }
}

TEST(LocalDeformation, strains_are_those_of_the_stretch) {
  EXPECT_DOUBLE_EQ(shear_strain({0.0, 0.5, 0.0, 0.0}), 0.5) << "a simple shear";
  EXPECT_DOUBLE_EQ(area_strain({0.0, 0.5, 0.0, 0.0}), 0.0);
  EXPECT_NEAR(vorticity({0.0, 2e-6, 0.0, 0.0}), -2e-6, 1e-17) << "clockwise if the upper side moves to +x";
  EXPECT_DOUBLE_EQ(shear_strain({0.25, 0.0, 0.0, -0.25}), 0.5);
  EXPECT_DOUBLE_EQ(area_strain({0.5, 0.0, 0.0, 1.0}), 2.0);
  EXPECT_DOUBLE_EQ(area_strain({-0.5, 0.0, 0.0, 0.0}), -0.5);
}

// Four neighbours at right angles, 1 m away. If the right one moves by e along x, the gradient contains a
// stretch of e / 2; because the left one does not move, a residual of e / 2 remains on each side.
TEST(LocalDeformation, leaves_what_no_gradient_explains) {
  constexpr double e = 0.01;
  Packing bed = test::empty_packing(100.0, false);
  test::add_grain(bed, 50.0, 50.0);
  for (const auto& [x, y] : {std::pair(51.0, 50.0), {49.0, 50.0}, {50.0, 51.0}, {50.0, 49.0}})
    test::add_floor_grain(bed, x, y);
  Frame now = bed.frame;
  now.x[1] += e;
  const LocalDeformation deformation = local_deformations(bed.frame, {now, bed.statics})[0];
  EXPECT_NEAR(deformation.gradient.xx, 0.5 * e, 1e-14);
  EXPECT_NEAR(deformation.gradient.yy, 0.0, 1e-14);
  EXPECT_NEAR(deformation.nonaffine, 2.0 * 0.25 * e * e / 4.0, 1e-16) << "mean over four neighbours";
}

TEST(LocalDeformation, takes_neighbours_within_two_diameters_as_they_were_before) {
  Packing bed = test::empty_packing(100.0, false);
  for (const auto& [x, y] : {std::pair(50.0, 50.0), {51.0, 50.0}, {50.0, 51.0}, {52.125, 50.0}})
    test::add_grain(bed, x, y);
  Frame now = bed.frame;
  now.x[3] = 51.75;  // approaches only now
  EXPECT_NEAR(local_deformations(bed.frame, {now, bed.statics})[0].gradient.xx, 0.0, 1e-14);
  bed.frame.x[3] = 51.875;
  EXPECT_LT(local_deformations(bed.frame, {now, bed.statics})[0].gradient.xx, -0.01);
}

TEST(LocalDeformation, is_unrolled_over_the_period) {
  Packing bed = with_images(test::triangular_lattice(12, 8, true));
  Frame now = bed.frame;
  for (std::size_t i = 0; i < now.x.size();
       ++i) {  // a simple shear that moves grains across the periodic edge
    now.x[i] += 2.0 * now.y[i];
    now.image[i] = static_cast<Index>(std::floor(now.x[i] / 12.0));
    now.x[i] -= 12.0 * now.image[i];
  }
  for (const LocalDeformation& deformation : local_deformations(bed.frame, {now, bed.statics})) {
    EXPECT_NEAR(deformation.gradient.xy, 2.0, 1e-12);
    EXPECT_NEAR(deformation.nonaffine, 0.0, 1e-12);
  }
}

TEST(LocalDeformation, has_neighbours_across_the_period) {
  const Packing bed = with_images(test::random_packing(6, 120, 12.0, 8.0, true));
  const Packing elsewhere = test::moved(bed, 5.5);
  Random random(8);
  Frame now = bed.frame, now_elsewhere = elsewhere.frame;
  for (std::size_t i = 0; i < now.x.size(); ++i) {
    const double x = random.below(1024) / 8192.0;  // exact
    now.x[i] += x;
    now_elsewhere.x[i] += x;
  }
  const auto here = local_deformations(bed.frame, {now, bed.statics});
  const auto there = local_deformations(elsewhere.frame, {now_elsewhere, bed.statics});
  for (std::size_t i = 0; i < here.size(); ++i) {
    EXPECT_NEAR(here[i].nonaffine, there[i].nonaffine, 1e-12);
    EXPECT_NEAR(here[i].gradient.xy, there[i].gradient.xy, 1e-12);
  }
}

TEST(LocalDeformation, is_not_known_without_neighbours_that_span_the_plane) {
  Packing bed = test::empty_packing(100.0, false);
  for (const double x : {10.0, 11.0, 12.0, 50.0}) test::add_grain(bed, x, 0.5);
  for (const LocalDeformation& deformation : local_deformations(bed.frame, bed)) {
    EXPECT_TRUE(std::isnan(deformation.nonaffine));
    EXPECT_TRUE(std::isnan(shear_strain(deformation.gradient)));
  }
  Packing fewer = test::empty_packing(100.0, false);
  test::add_grain(fewer, 10.0, 0.5);
  EXPECT_TRUE(std::isnan(local_deformations(fewer.frame, bed)[0].nonaffine)) << "a frame of other grains";
}

// The upper half of a lattice slides over the lower half.
TEST(LocalDeformation, of_a_slip_is_localised) {
  constexpr double slip = 0.2;
  const Packing bed = with_images(test::triangular_lattice(20, 40, true));
  Frame now = bed.frame, uniform = moved_by(bed.frame, {1.0, 0.01, 0.0, 1.0});
  for (std::size_t i = 0; i < now.x.size(); ++i)
    if (now.y[i] > 17.5) now.x[i] += slip;
  FrameRecord slipped, sheared;
  measure_deformation(bed.frame, {now, bed.statics}, slipped);
  measure_deformation(bed.frame, {uniform, bed.statics}, sheared);
  EXPECT_GT(slipped.local_shear_share, 0.99) << "four of forty rows contain all of it";
  EXPECT_NEAR(sheared.local_shear_share, 0.1, 1e-9);
  EXPECT_NEAR(sheared.local_shear, 0.01, 1e-12);
  EXPECT_NEAR(sheared.nonaffine, 0.0, 1e-9);
  EXPECT_GT(slipped.nonaffine_largest, 0.1 * slip);
  EXPECT_LT(slipped.nonaffine_largest, slip);
  const double in_four_rows = slipped.nonaffine_largest * std::sqrt(4.0 / 40.0);
  EXPECT_LT(slipped.nonaffine, in_four_rows);
  EXPECT_GT(slipped.nonaffine, 0.5 * in_four_rows);
}

TEST(LocalDeformation, of_a_bed_that_does_not_move_has_no_share) {
  const Packing bed = random_bed();
  FrameRecord record;
  measure_deformation(bed.frame, bed, record);
  EXPECT_EQ(record.local_shear, 0.0);
  EXPECT_EQ(record.nonaffine_largest, 0.0);
  EXPECT_TRUE(std::isnan(record.local_shear_share));
}

}  // namespace
}  // namespace talus::analysis
