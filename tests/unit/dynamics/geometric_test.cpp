///

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "core/trigonometry.h"
#include "dynamics/bed.h"
#include "dynamics/step.h"

namespace talus::dynamics {
namespace {

constexpr double round_off = 1e-12;  // D

BedPlan plan_of(double size_ratio, bool periodic, bool rough, std::uint64_t seed) {
  BedPlan plan;
  plan.size_ratio = size_ratio;
  plan.length =
      (seed % 2 == 0 ? 10.0 : 12.3) * plan.mean_diameter;  // an integer or non-integer number of grains
  plan.grain_count = 120;
  plan.periodic = periodic;
  plan.rough_floor = rough;
  plan.seed = seed;
  return plan;
}

/// Runs the test for size ratios from one to four, with and without walls, with rough and smooth floors, and
/// with several seeds.
void for_all_plans(const std::function<void(const BedPlan&)>& test) {
  for (const double size_ratio : {1.0, 1.5, 4.0})
    for (const bool periodic : {true, false})
      for (const bool rough : {true, false})
        for (std::uint64_t seed = 1; seed <= 4; ++seed) {
          SCOPED_TRACE("size ratio " + std::to_string(size_ratio) + (periodic ? ", periodic" : ", walls") +
                       (rough ? ", rough" : ", smooth") + ", seed " + std::to_string(seed));
          test(plan_of(size_ratio, periodic, rough, seed));
        }
}

/// Calls visit(dx, dy, gap) for a grain and each other body before `end`, through all images; in D.
template <typename Visit>
void visit_bodies(const World& world, Index grain, Index end, double diameter, Visit visit) {
  const Grains& g = world.grains;
  const int images = world.boundary.periodic ? 1 : 0;
  for (Index other = 0; other < g.count(); ++other) {
    if (other >= end && other < g.free_count) continue;
    for (int image = -images; image <= images; ++image) {
      if (other == grain && image == 0) continue;
      const double dx = g.x[other] + image * world.boundary.length - g.x[grain];
      const double dy = g.y[other] - g.y[grain];
      const double gap = std::sqrt(dx * dx + dy * dy) - g.radius[grain] - g.radius[other];
      visit(dx / diameter, dy / diameter, gap / diameter);
    }
  }
  for (const Plane& plane : world.boundary.planes) {
    const double distance = plane.normal.x * g.x[grain] + plane.normal.y * g.y[grain] - plane.offset;
    visit(-plane.normal.x, -plane.normal.y, (distance - g.radius[grain]) / diameter);
  }
}

TEST(GeometricBed, no_two_bodies_overlap) {
  for (const double critical_angle : {0.0, 0.5})
    for_all_plans([&](const BedPlan& plan) {
      const World world = make_geometric_bed(plan, {.critical_angle = critical_angle});
      double smallest = 1.0;
      for (Index i = 0; i < plan.grain_count; ++i)
        visit_bodies(world, i, plan.grain_count, plan.mean_diameter,
                     [&](double, double, double gap) { smallest = std::min(smallest, gap); });
      EXPECT_GE(smallest, -round_off);
      EXPECT_LE(smallest, round_off);
    });
}

TEST(GeometricBed, a_grain_that_always_rolls_is_held_on_both_sides) {
  for_all_plans([](const BedPlan& plan) {
    const World world = make_geometric_bed(plan, {});
    for (Index i = 0; i < plan.grain_count; ++i) {
      bool left = false, right = false;
      visit_bodies(world, i, i, plan.mean_diameter, [&](double dx, double dy, double gap) {
        if (std::fabs(gap) > round_off) return;
        const bool plane_below = dx == 0.0 && dy == -1.0;
        left = left || dx < 0.0 || plane_below;
        right = right || dx > 0.0 || plane_below;
      });
      EXPECT_TRUE(left && right) << "grain " << i;
    }
  });
}

// Each grain lies where a vertical fall meets the earlier bodies, and nothing else has moved.
TEST(GeometricBed, grains_that_never_roll_are_deposited_ballistically) {
  for_all_plans([](const BedPlan& plan) {
    const World world = make_geometric_bed(plan, {.critical_angle = radians(90.0)});
    const Grains& g = world.grains;
    for (Index i = 0; i < plan.grain_count; ++i) {
      double height = plan.rough_floor ? -1.0 : g.radius[i];
      for (Index other = 0; other < g.count(); ++other) {
        if (other >= i && other < g.free_count) continue;
        for (const double image : {-plan.length, 0.0, plan.length}) {
          const double dx = g.x[other] + (plan.periodic ? image : 0.0) - g.x[i];
          const double reach = g.radius[i] + g.radius[other];
          if (std::fabs(dx) < reach)
            height = std::max(height, g.y[other] + std::sqrt(reach * reach - dx * dx));
        }
      }
      EXPECT_NEAR(g.y[i], height, round_off * plan.mean_diameter) << "grain " << i;
    }
  });
}

double mean_height(const World& world) {
  double sum = 0.0;
  for (Index i = 0; i < world.grains.free_count; ++i) sum += world.grains.y[i];
  return sum / world.grains.free_count;
}

TEST(GeometricBed, the_lowest_of_many_sites_makes_a_denser_bed) {
  for (const bool periodic : {true, false}) {
    const BedPlan plan = plan_of(1.5, periodic, true, 1);
    const double one = mean_height(make_geometric_bed(plan, {}));
    const double twenty = mean_height(make_geometric_bed(plan, {.sites = 20}));
    EXPECT_LT(twenty, 0.97 * one);
  }
}

TEST(GeometricBed, a_larger_critical_angle_makes_a_looser_bed) {
  const BedPlan plan = plan_of(1.5, true, true, 1);
  double height = 0.0;
  for (const double degrees : {0.0, 20.0, 45.0, 90.0}) {
    const double next = mean_height(make_geometric_bed(plan, {.critical_angle = radians(degrees)}));
    EXPECT_GT(next, height);
    height = next;
  }
}

TEST(GeometricBed, is_the_same_for_the_same_plan_and_another_for_another_seed) {
  const BedPlan plan = plan_of(1.5, true, true, 1);
  BedPlan other = plan;
  other.seed = 3;
  EXPECT_EQ(state_hash(make_geometric_bed(plan, {})), state_hash(make_geometric_bed(plan, {})));
  EXPECT_NE(state_hash(make_geometric_bed(plan, {})), state_hash(make_geometric_bed(other, {})));
}

TEST(GeometricBed, has_the_grains_asked_for_at_rest_and_inside) {
  for_all_plans([](const BedPlan& plan) {
    const World world = make_geometric_bed(plan, {.sites = 2});
    const Grains& g = world.grains;
    EXPECT_EQ(g.free_count, plan.grain_count);
    EXPECT_EQ(g.count() - g.free_count, plan.rough_floor ? std::floor(plan.length / plan.mean_diameter) : 0);
    for (Index i = 0; i < g.free_count; ++i) {
      EXPECT_GE(g.radius[i], 0.5 * smallest_diameter(plan));
      EXPECT_LE(g.radius[i], 0.5 * largest_diameter(plan));
      EXPECT_GE(g.x[i], 0.0);
      EXPECT_LT(g.x[i], plan.length);
      EXPECT_EQ(g.vx[i], 0.0);
      EXPECT_EQ(g.vy[i], 0.0);
      EXPECT_EQ(g.omega[i], 0.0);
    }
  });
}

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
