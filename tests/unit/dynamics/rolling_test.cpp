#include "dynamics/rolling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/errors.h"

namespace talus::dynamics {
namespace {

constexpr double length = 20.0;
constexpr double exact = 1e-14;

/// Returns discs on or above the plane y = 0, in a box that is periodic or has walls.
DiscGrid box(bool periodic, const std::vector<PlacedDisc>& discs) {
  Boundary boundary{.periodic = periodic, .length = length, .planes = {}};
  if (!periodic)
    boundary.planes = {{.normal = {1.0, 0.0}, .offset = 0.0}, {.normal = {-1.0, 0.0}, .offset = -length}};
  boundary.planes.push_back({.normal = {0.0, 1.0}, .offset = 0.0, .wall = false});
  DiscGrid grid(boundary, 2.0);
  for (const PlacedDisc& disc : discs) grid.add(disc);
  return grid;
}

void expect_at(Vec2 expected, Vec2 found) {
  EXPECT_NEAR(found.x, expected.x, exact);
  EXPECT_NEAR(found.y, expected.y, exact);
}

TEST(Rolling, a_grain_falls_onto_the_plane_where_nothing_is_in_its_way) {
  expect_at({7.0, 0.5}, resting_place(box(true, {{3.0, 0.5, 0.5}}), {7.0, 0.5}));
}

// For equal radii, the three centres form an equilateral triangle of side 2 r.
TEST(Rolling, a_grain_on_two_equal_ones_side_by_side_ends_at_the_apex_of_the_triangle) {
  const DiscGrid bed = box(true, {{9.5, 0.5, 0.5}, {10.5, 0.5, 0.5}});
  for (const double x : {9.5001, 9.7, 9.99, 10.0, 10.2, 10.4999})
    expect_at({10.0, 0.5 + std::sqrt(3.0) / 2.0}, resting_place(bed, {x, 0.5}));
}

TEST(Rolling, and_so_it_does_across_the_periodic_edge) {
  const DiscGrid bed = box(true, {{length - 0.25, 0.5, 0.5}, {0.75, 0.5, 0.5}});
  for (const double x : {length - 0.2, 0.1, 0.5})
    expect_at({0.25, 0.5 + std::sqrt(3.0) / 2.0}, resting_place(bed, {x, 0.5}));
}

// The grain detaches at the equator, at a distance of the sum of radii from the axis of the grain below.
TEST(Rolling, a_grain_rolls_off_a_larger_one_and_falls_from_its_equator) {
  const DiscGrid bed = box(true, {{10.0, 1.0, 1.0}});
  expect_at({11.25, 0.25}, resting_place(bed, {10.1, 0.25}));
  expect_at({8.75, 0.25}, resting_place(bed, {9.9, 0.25}));
}

// The larger grain reaches the plane first. Both touch the plane, so their distance along it is 2 sqrt(r R).
TEST(Rolling, a_larger_grain_rolls_off_a_smaller_one_down_to_the_plane) {
  const DiscGrid bed = box(true, {{10.0, 0.25, 0.25}});
  expect_at({10.0 + 2.0 * std::sqrt(0.25 * 1.0), 1.0}, resting_place(bed, {10.1, 1.0}));
}

TEST(Rolling, a_wall_holds_a_grain_from_the_other_side) {
  const DiscGrid bed = box(false, {{0.75, 0.5, 0.5}, {length - 0.75, 0.5, 0.5}});
  const double height = 0.5 + std::sqrt(1.0 - 0.25 * 0.25);
  expect_at({0.5, height}, resting_place(bed, {0.6, 0.5}));
  expect_at({length - 0.5, height}, resting_place(bed, {length - 0.6, 0.5}));
}

// Three grains in a row, each lower than the previous one: the grain rolls over the second to the far side of
// the third.
TEST(Rolling, a_grain_rolls_from_one_grain_to_the_next) {
  const DiscGrid bed = box(true, {{9.0, 2.5, 0.5}, {9.75, 1.8, 0.5}, {10.5, 1.2, 0.5}});
  expect_at({11.5, 0.5}, resting_place(bed, {9.1, 0.5}));
}

TEST(Rolling, an_overhanging_grain_stops_one_that_rolls_underneath) {
  // On the first grain, in contact with the second above and to the right: the two circles of radius 1
  // intersect.
  const DiscGrid bed = box(true, {{10.0, 3.0, 0.5}, {11.5, 3.6, 0.5}});
  const Vec2 place = resting_place(bed, {9.99, 0.5});  // rolls off to the left, for comparison
  expect_at({9.0, 0.5}, place);
  const Vec2 held = resting_place(bed, {10.4, 0.5});
  EXPECT_NEAR(std::hypot(held.x - 10.0, held.y - 3.0), 1.0, exact);
  EXPECT_NEAR(std::hypot(held.x - 11.5, held.y - 3.6), 1.0, exact);
  EXPECT_LT(held.x, 11.5);
}

// sin 30 deg = 1/2: with centres 1 apart, the limit is 1/2 from the axis.
TEST(Rolling, a_grain_stays_where_it_has_fallen_up_to_the_critical_angle) {
  const DiscGrid bed = box(true, {{10.0, 0.5, 0.5}});
  for (const double side : {-1.0, 1.0}) {
    const double inside = 10.0 + side * 0.4999, outside = 10.0 + side * 0.5001;
    const double across = inside - 10.0;
    expect_at({inside, 0.5 + std::sqrt(1.0 - across * across)}, resting_place(bed, {inside, 0.5, 0.5}));
    expect_at({10.0 + side, 0.5}, resting_place(bed, {outside, 0.5, 0.5}));
  }
  expect_at({11.0, 0.5},
            resting_place(bed, {10.0, 0.5, 0.0}));  // without a critical angle it rolls even from the top
}

// A grain that rolls over the second has not fallen on it.
TEST(Rolling, the_critical_angle_does_not_hold_a_grain_that_rolls) {
  const DiscGrid bed = box(true, {{9.0, 2.5, 0.5}, {9.9, 1.8, 0.5}});
  const double steep = 0.6;  // released at 9.7: offset 0.7 on the first grain, less than 0.6 on the second
  expect_at({10.9, 0.5}, resting_place(bed, {9.7, 0.5, steep}));
}

}  // namespace
}  // namespace talus::dynamics
