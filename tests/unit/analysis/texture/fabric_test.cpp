#include "analysis/texture/fabric.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/trigonometry.h"
#include "unit/analysis/packings.h"

namespace talus::analysis {
namespace {

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
  EXPECT_NEAR(fabric_component(packing.frame, 6).amplitude, 2.0, 1e-12);
  EXPECT_NEAR(fabric_component(packing.frame, 6).angle, 4.0, 1e-12);
  EXPECT_NEAR(fabric_component(packing.frame, 2).amplitude, 0.0, 1e-12);
}

// A density 1 + a cos 2 (theta - theta_2) has amplitude a; here two directions lie 30 deg to either side of
// 150 deg.
TEST(FabricComponent, of_two_directions) {
  const test::Packing packing = contacts_at({120.0, 180.0});
  EXPECT_NEAR(fabric_component(packing.frame, 2).amplitude, 2.0 * std::cos(radians(60.0)), 1e-12);
  EXPECT_NEAR(fabric_component(packing.frame, 2).angle, 150.0, 1e-12);
}

TEST(FabricComponent, of_nothing_is_nan) {
  EXPECT_TRUE(std::isnan(fabric_component(contacts_at({}).frame, 2).amplitude));
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
