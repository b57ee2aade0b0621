#include "analysis/deformation/local_deformation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "core/trigonometry.h"
#include "unit/analysis/packings.h"

namespace talus::analysis {
namespace {

using test::Packing;

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
    EXPECT_NEAR(deformation.gradient.xx, 0.1, 1e-12);
    EXPECT_NEAR(deformation.gradient.xy, 0.3, 1e-12);
    EXPECT_NEAR(deformation.gradient.yx, -0.2, 1e-12);
    EXPECT_NEAR(deformation.gradient.yy, -0.1, 1e-12);
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
