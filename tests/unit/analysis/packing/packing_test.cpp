#include "analysis/packing/packing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/trigonometry.h"
#include "unit/analysis/packings.h"

namespace talus::analysis {
namespace {

using test::Packing;

/// Returns disks of weight 1 and radius 1/2 stacked on a floor grain; the k-th contact from above carries k
/// weights.
Packing stack_of(Index count) {
  Packing packing = test::empty_packing(10.0, false);
  for (Index i = 0; i < count; ++i) test::add_grain(packing, 5.0, 0.5 + i);
  const Index floor = test::add_floor_grain(packing, 5.0, -0.5);
  for (Index i = 0; i + 1 < count; ++i) test::add_contact(packing, i, i + 1, count - 1 - i);
  test::add_contact(packing, 0, floor, count);
  test::moments_from_contacts(packing);
  return packing;
}

// Each disk has M_yy = (force below + force above) / 2, so the sum over n disks is n^2 / 2.
TEST(PackingStress, of_a_stack) {
  const Packing packing = stack_of(4);
  const PackingStress stress = packing_stress(packing, 2.0);
  EXPECT_NEAR(stress.sigma.yy, 16.0 / 2.0 / 2.0, 1e-15);
  EXPECT_EQ(stress.sigma.xx, 0.0);
  EXPECT_EQ(stress.shear_over_normal, 0.0);
  EXPECT_EQ(stress.state.ratio, 1.0);
  EXPECT_EQ(packing.frame.gamma[2], 1.0);
}

// From 5 D above the floor to 5 D below the top of a square lattice of touching disks, 1 wide and 20 high.
TEST(BulkSolidFraction, of_a_square_lattice_is_a_quarter_of_pi_whatever_is_cut) {
  Packing packing = test::empty_packing(10.0, true);
  for (Index k = 0; k < 200; ++k) test::add_grain(packing, 0.5 + k % 10, 0.5 + k / 10);
  EXPECT_NEAR(bulk_solid_fraction(packing, 200.0), 0.25 * pi, 1e-12);
  EXPECT_NEAR(bulk_solid_fraction(packing, 193.0), 0.25 * pi, 0.02) << "0.3 of a row is cut off";
  EXPECT_TRUE(std::isnan(bulk_solid_fraction(packing, 100.0))) << "empty range";
}

/// Returns a disk on two others of its size, which it touches at 30 deg to the vertical; they lie on the
/// floor, and `side` holds them from the side.
Packing arch() {
  Packing packing = test::empty_packing(10.0, false);
  const Index left = test::add_grain(packing, 4.5, 0.5);
  const Index right = test::add_grain(packing, 5.5, 0.5);
  const Index top = test::add_grain(packing, 5.0, 0.5 + std::sqrt(0.75));
  const double fn = 0.5 / std::sqrt(0.75);  // for each contact, with a weight of 1
  test::add_contact(packing, left, top, fn);
  test::add_contact(packing, right, top, fn);
  test::moments_from_contacts(packing);
  return packing;
}

// M of the keystone is 2 r fn (sin^2 30, cos^2 30), so gamma = cos 60.
TEST(PackingStress, of_an_arch) {
  const Packing packing = arch();
  EXPECT_NEAR(packing.frame.gamma[2], 0.5, 1e-12);
  const double fn = 0.5 / std::sqrt(0.75);
  const PackingStress stress = packing_stress(packing, 1.0);
  // The two feet together carry as much as the keystone, and their shears cancel.
  EXPECT_NEAR(stress.sigma.xx, 2.0 * fn * 0.25, 1e-12);
  EXPECT_NEAR(stress.sigma.yy, 2.0 * fn * 0.75, 1e-12);
  EXPECT_NEAR(stress.sigma.xy, 0.0, 1e-12);
  EXPECT_NEAR(packing.frame.internal_moment[0].xy, 0.5 * fn * 0.5 * std::sqrt(0.75), 1e-12);
}

TEST(PackingStress, leaves_out_the_floor) {
  Packing packing = stack_of(2);
  packing.frame.internal_moment.back() = {5.0, 0.0, 0.0, 5.0};
  EXPECT_EQ(packing_stress(packing, 1.0).sigma.xx, 0.0);
}

TEST(PackingStress, turned_and_mirrored) {
  const Packing packing = test::random_packing(5, 50, 10.0, 10.0, false);
  const PackingStress stress = packing_stress(packing, 100.0);
  const Packing turned = test::turned(packing);
  const Packing mirrored = test::mirrored(packing);
  const PackingStress quarter = packing_stress(turned, 100.0);
  EXPECT_EQ(quarter.sigma.xx, stress.sigma.yy);
  EXPECT_EQ(quarter.shear, -stress.shear);
  EXPECT_EQ(quarter.state.ratio, stress.state.ratio);
  const PackingStress mirror = packing_stress(mirrored, 100.0);
  EXPECT_EQ(mirror.normal, stress.normal);
  EXPECT_EQ(mirror.shear, -stress.shear);
  EXPECT_EQ(stress.shear, -stress.sigma.yx);
}

TEST(SectionStress, adds_up_to_that_of_the_packing) {
  const Packing packing = test::random_packing(6, 400, 20.0, 10.0, true);
  const PackingStress whole = packing_stress(packing, 200.0);
  const std::vector<Tensor2> sections = section_stresses(packing, 200.0, 7);
  Tensor2 mean;
  for (const Tensor2& section : sections) {
    mean.xx += section.xx / 7.0;
    mean.xy += section.xy / 7.0;
    mean.yx += section.yx / 7.0;
    mean.yy += section.yy / 7.0;
  }
  EXPECT_NEAR(mean.xx, whole.sigma.xx, 1e-12);
  EXPECT_NEAR(mean.xy, whole.sigma.xy, 1e-12);
  EXPECT_NEAR(mean.yx, whole.sigma.yx, 1e-12);
  EXPECT_NEAR(mean.yy, whole.sigma.yy, 1e-12);
}

TEST(SectionStress, goes_by_the_centres) {
  Packing packing = test::empty_packing(10.0, false);
  const Tensor2 moment = {1.0, 0.0, 0.0, 2.0};
  test::add_grain(packing, 0.0, 0.0, 0.5, moment);
  test::add_grain(packing, 4.99, 0.0, 0.5, moment);
  test::add_grain(packing, 5.0, 0.0, 0.5, moment);
  test::add_grain(packing, 10.0, 0.0, 0.5, moment);  // the end belongs to the last section
  test::add_grain(packing, 9.0, 0.0, 0.5, moment);
  const std::vector<Tensor2> sections = section_stresses(packing, 4.0, 2);
  ASSERT_EQ(sections.size(), 2u);
  EXPECT_EQ(sections[0].xx, 1.0);
  EXPECT_EQ(sections[1].xx, 1.5);
  EXPECT_EQ(sections[1].yy, 3.0);
}

// See the test of bed_volume: the upper half of a disk is on average pi/4 r above its centre.
TEST(FrameVolume, is_the_area_below_the_surface) {
  for (const bool periodic : {false, true}) {
    Packing packing = test::empty_packing(10.0, periodic);
    for (Index k = 0; k < 10; ++k) test::add_grain(packing, k + 0.5, 0.75);
    test::add_floor_grain(packing, 5.0, 9.0);
    EXPECT_NEAR(frame_volume(packing), 10.0 * (0.75 + 0.125 * pi), 0.1);
  }
}

TEST(StressRatioDistribution, is_that_of_free_grains_that_carry_something) {
  Packing packing = stack_of(3);
  test::add_floor_grain(packing, 8.0, -0.5);
  packing.frame.gamma = {0.1, std::nan(""), 0.95, 0.5, 0.5};
  const Histogram histogram = stress_ratio_distribution(packing, 10);
  EXPECT_EQ(histogram.total, 2.0);
  EXPECT_EQ(histogram.weight[1], 1.0);
  EXPECT_EQ(histogram.weight[9], 1.0);
}

}  // namespace
}  // namespace talus::analysis
