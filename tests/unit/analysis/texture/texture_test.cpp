/// Fabric and texture of contacts.

#include "analysis/texture/texture.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/trigonometry.h"
#include "unit/analysis/packings.h"

namespace talus::analysis {
namespace {

using test::Packing;

/// Returns two grains of radius 1/2, then two of radius 3/4; contacts between them have any direction.
Packing two_pairs() {
  Packing packing = test::empty_packing(10.0, false);
  for (const double radius : {0.5, 0.5, 0.75, 0.75}) test::add_grain(packing, 2.0 * radius, 1.0, radius);
  packing.frame.x = {0.0, 1.0, 0.0, 1.0};
  return packing;
}

void add_directed(Packing& packing, Index a, double angle, double fn, double ft = 0.0) {
  test::add_contact(packing, a, a + 1, fn, ft);
  packing.frame.contacts.nx.back() = std::cos(angle);
  packing.frame.contacts.ny.back() = std::sin(angle);
}

FrameRecord texture_of(const Packing& packing) {
  FrameRecord record;
  measure_texture(packing, record);
  return record;
}

// For directions all around, sums of cosines equal the integrals.
TEST(Texture, of_forces_is_what_they_were_made_with) {
  Packing packing = two_pairs();
  const double axis = radians(70.0);
  for (int k = 0; k < 36; ++k) {
    const double angle = radians(5.0 * k);
    add_directed(packing, 0, angle, 2.0 * (1.0 + 0.3 * std::cos(2.0 * (angle - axis))),
                 2.0 * -0.2 * std::sin(2.0 * (angle - axis)));
  }
  const FrameRecord texture = texture_of(packing);
  EXPECT_NEAR(texture.texture_axis, axis, 1e-12);
  EXPECT_NEAR(texture.texture_contacts, 0.0, 1e-12);
  EXPECT_NEAR(texture.texture_normal_forces, 0.3, 1e-12);
  EXPECT_NEAR(texture.texture_tangential_forces, 0.2, 1e-12);
  EXPECT_NEAR(texture.texture_branches, 0.0, 1e-12);
  EXPECT_NEAR(texture.texture_stress_ratio, 0.25, 1e-12);
}

// Three contacts along the bed, longer than the others; 2 at 45 and at 135 deg, one across. The sum of
// cosines is 2 of 8, that of lengths 3.5 of 9.5. For equal forces this is Gamma.
TEST(Texture, of_contacts_and_lengths) {
  Packing packing = two_pairs();
  for (int k = 0; k < 3; ++k) add_directed(packing, 2, 0.0, 1.0);
  for (const double angle : {45.0, 45.0, 90.0, 135.0, 135.0}) add_directed(packing, 0, radians(angle), 1.0);
  const FrameRecord texture = texture_of(packing);
  EXPECT_NEAR(texture.texture_axis, 0.0, 1e-12);
  EXPECT_NEAR(texture.texture_contacts, 0.5, 1e-12);
  EXPECT_NEAR(texture.texture_normal_forces, 0.0, 1e-12);
  EXPECT_NEAR(texture.texture_tangential_forces, 0.0, 1e-12);
  EXPECT_NEAR(texture.texture_branches, 7.0 / 9.5 - 0.5, 1e-12);
  EXPECT_NEAR(texture.texture_stress_ratio, 3.5 / 9.5, 1e-12);
}

TEST(Texture, of_no_contacts_is_not_known) {
  EXPECT_TRUE(std::isnan(texture_of(two_pairs()).texture_axis));
  EXPECT_TRUE(std::isnan(texture_of(two_pairs()).texture_stress_ratio));
}

/// Returns contacts with the given directions (deg) between grains at arbitrary places, with f_n = 1, 2, ...
test::Packing contacts_at(const std::vector<double>& directions) {
  test::Packing packing = test::empty_packing(10.0, false);
  test::add_grain(packing, 0.0, 0.0);
  double fn = 1.0;
  for (double direction : directions) {
    const Index id = test::add_grain(packing, std::cos(radians(direction)), std::sin(radians(direction)));
    test::add_contact(packing, 0, id, fn++);
  }
  return packing;
}

TEST(NormalDirections, are_the_same_for_a_normal_and_its_opposite) {
  const test::Packing packing = contacts_at({10.0, 190.0, 100.0, -50.0, 0.0, 180.0});
  const Histogram plain = normal_directions(packing.frame, 6, false);
  EXPECT_EQ(plain.weight, (std::vector<double>{4.0, 0.0, 0.0, 1.0, 1.0, 0.0}));
  const Histogram weighted = normal_directions(packing.frame, 6, true);
  EXPECT_EQ(weighted.weight, (std::vector<double>{14.0, 0.0, 0.0, 3.0, 4.0, 0.0}));
}

TEST(FabricComponent, of_a_triangular_lattice) {
  const test::Packing packing = contacts_at({4.0, 64.0, 124.0, 184.0, 244.0, 304.0});
  EXPECT_NEAR(fabric_component(packing.frame.contacts, 6).amplitude, 2.0, 1e-12);
  EXPECT_NEAR(fabric_component(packing.frame.contacts, 6).angle, 4.0, 1e-12);
  EXPECT_NEAR(fabric_component(packing.frame.contacts, 2).amplitude, 0.0, 1e-12);
}

// A density 1 + a cos 2 (theta - theta_2) has amplitude a; here two directions lie 30 deg to either side of
// 150 deg.
TEST(FabricComponent, of_two_directions) {
  const test::Packing packing = contacts_at({120.0, 180.0});
  EXPECT_NEAR(fabric_component(packing.frame.contacts, 2).amplitude, 2.0 * std::cos(radians(60.0)), 1e-12);
  EXPECT_NEAR(fabric_component(packing.frame.contacts, 2).angle, 150.0, 1e-12);
}

TEST(FabricComponent, of_nothing_is_nan) {
  EXPECT_TRUE(std::isnan(fabric_component(contacts_at({}).frame.contacts, 2).amplitude));
  EXPECT_TRUE(std::isnan(direction_peaks(contacts_at({}).frame)[0]));
}

TEST(DirectionPeaks, are_where_directions_concentrate) {
  // Peaks at -3, 62 and 117 deg, each with some spread, a broad background, and a few values at one place
  // that are not a peak.
  std::vector<double> directions;
  for (int peak : {177, 62, 117})
    for (int side : {-6, -3, 0, 0, 0, 3, 6}) directions.push_back(peak + side);
  for (int k = 0; k < 18; ++k) directions.push_back(10.0 * k);
  for (int k = 0; k < 4; ++k) directions.push_back(85.0);
  const std::array<double, 3> peaks = direction_peaks(contacts_at(directions).frame);
  EXPECT_NEAR(peaks[0], -3.0, 1.0);
  EXPECT_NEAR(peaks[1], 62.0, 1.0);
  EXPECT_NEAR(peaks[2], 117.0, 1.0);
}

}  // namespace
}  // namespace talus::analysis
