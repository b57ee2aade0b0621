#include <gtest/gtest.h>

#include <algorithm>

#include "core/trigonometry.h"
#include "dynamics/bed.h"
#include "support/scenes.h"

namespace talus::dynamics {
namespace {

BedPlan plan_of(bool periodic, double columns, Index count) {
  BedPlan plan;
  plan.length = columns * plan.mean_diameter;
  plan.grain_count = count;
  plan.periodic = periodic;
  return plan;
}

TEST(LooseBed, is_the_same_for_the_same_plan_and_another_for_another_seed) {
  const BedPlan plan = plan_of(true, 30.0, 200);
  BedPlan other = plan;
  other.seed = 2;
  EXPECT_EQ(state_hash(make_loose_bed(plan)), state_hash(make_loose_bed(plan)));
  EXPECT_NE(state_hash(make_loose_bed(plan)), state_hash(make_loose_bed(other)));
}

TEST(LooseBed, has_the_grains_asked_for_at_rest_above_the_floor_and_inside_the_walls) {
  for (const bool periodic : {true, false}) {
    const BedPlan plan = plan_of(periodic, 30.0, 500);
    const World world = make_loose_bed(plan);
    const Grains& g = world.grains;
    EXPECT_EQ(g.free_count, 500);
    EXPECT_EQ(world.boundary.periodic, periodic);
    EXPECT_EQ(world.boundary.planes.size(), periodic ? 0u : 2u);
    for (Index i = 0; i < g.free_count; ++i) {
      EXPECT_GE(g.x[i], g.radius[i]);
      EXPECT_LE(g.x[i], plan.length - g.radius[i]);
      EXPECT_GE(g.y[i], g.radius[i]);
      EXPECT_EQ(g.vx[i], 0.0);
      EXPECT_EQ(g.vy[i], 0.0);
      EXPECT_EQ(g.omega[i], 0.0);
      EXPECT_DOUBLE_EQ(g.mass[i], plan.density * pi * g.radius[i] * g.radius[i]);
    }
  }
}

// Uniform in [0.8, 1.2] D: mean D, variance (0.4 D)^2 / 12. With 2000 grains the standard error of the mean
// is 0.0026 D and that of the variance 0.00024 D^2; four standard errors are allowed.
TEST(LooseBed, sizes_are_uniform_between_the_smallest_and_the_largest) {
  const BedPlan plan = plan_of(true, 60.0, 2000);
  const World world = make_loose_bed(plan);
  double sum = 0.0, squares = 0.0, smallest = 1.0, largest = 0.0;
  for (Index i = 0; i < world.grains.free_count; ++i) {
    const double d = 2.0 * world.grains.radius[i] / plan.mean_diameter;
    sum += d;
    squares += d * d;
    smallest = std::min(smallest, d);
    largest = std::max(largest, d);
  }
  const double mean = sum / plan.grain_count;
  EXPECT_GE(smallest, 0.8);
  EXPECT_LT(smallest, 0.802);
  EXPECT_LE(largest, 1.2);
  EXPECT_GT(largest, 1.198);
  EXPECT_NEAR(mean, 1.0, 0.0104);
  EXPECT_NEAR(squares / plan.grain_count - mean * mean, 0.16 / 12.0, 0.001);
}

TEST(LooseBed, one_size_is_possible) {
  BedPlan plan = plan_of(true, 30.0, 100);
  plan.size_ratio = 1.0;
  const World world = make_loose_bed(plan);
  for (double r : world.grains.radius) EXPECT_DOUBLE_EQ(r, 0.5 * plan.mean_diameter);
}

TEST(LooseBed, grains_do_not_overlap) {
  for (const bool periodic : {true, false})
    for (double columns : {6.0, 8.0, 10.0, 13.0, 20.0, 50.0})
      for (double fraction : {0.3, 0.5, 0.7}) {
        BedPlan plan = plan_of(periodic, columns, 100);
        EXPECT_GE(test::smallest_gap(make_loose_bed(plan, fraction)), -1e-16)
            << columns << " D long, solid fraction " << fraction;
      }
}

TEST(LooseBed, fills_its_lattice_with_the_solid_fraction_asked_for) {
  BedPlan plan = plan_of(true, 100.0, 4000);
  for (double fraction : {0.2, 0.35, 0.5}) {
    const World world = make_loose_bed(plan, fraction);
    double area = 0.0, top = 0.0;
    for (Index i = 0; i < world.grains.free_count; ++i) {
      area += pi * world.grains.radius[i] * world.grains.radius[i];
      top = std::max(top, world.grains.y[i] + world.grains.radius[i]);
    }
    EXPECT_NEAR(area / (plan.length * top), fraction, 0.03 * fraction);
  }
}

// A square cell as wide as the largest grain gives 0.25 pi <d^2> / Dmax^2, with <d^2> = D^2 + (0.4 D)^2 / 12.
TEST(LooseBed, the_largest_solid_fraction_is_that_of_one_grain_in_each_cell) {
  EXPECT_NEAR(largest_initial_solid_fraction(1.5), 0.25 * pi * (1.0 + 0.16 / 12.0) / 1.44, 1e-15);
  EXPECT_NEAR(largest_initial_solid_fraction(1.0), 0.25 * pi, 1e-15);
}

TEST(LooseBed, ids_grow_from_the_floor_upwards) {
  const World world = make_loose_bed(plan_of(true, 30.0, 300));
  double lower = 0.0, upper = 0.0;
  for (Index i = 0; i < 100; ++i) {
    lower += world.grains.y[i];
    upper += world.grains.y[200 + i];
  }
  EXPECT_LT(lower, upper);
  EXPECT_LT(world.grains.y[0], world.grains.y[299]);
}

TEST(LooseBed, a_rough_floor_is_a_row_of_touching_grains_with_their_tops_at_zero) {
  const BedPlan plan = plan_of(true, 30.0, 10);
  const World world = make_loose_bed(plan);
  const Grains& g = world.grains;
  ASSERT_EQ(g.count() - g.free_count, 30);
  for (Index i = g.free_count; i < g.count(); ++i) {
    EXPECT_EQ(g.radius[i], 0.5 * plan.mean_diameter);
    EXPECT_EQ(g.y[i] + g.radius[i], 0.0);
    EXPECT_EQ(g.inverse_mass[i], 0.0);
    EXPECT_NEAR(g.x[i], (i - g.free_count + 0.5) * plan.mean_diameter, 1e-16);
  }
}

TEST(LooseBed, a_smooth_floor_is_a_plane_with_the_friction_of_grains) {
  BedPlan plan = plan_of(false, 30.0, 10);
  plan.rough_floor = false;
  const World world = make_loose_bed(plan);
  EXPECT_EQ(world.grains.count(), 10);
  ASSERT_EQ(world.boundary.planes.size(), 3u);
  EXPECT_TRUE(world.boundary.planes[0].wall);
  EXPECT_TRUE(world.boundary.planes[1].wall);
  EXPECT_FALSE(world.boundary.planes[2].wall);
  EXPECT_EQ(world.boundary.planes[2].normal.y, 1.0);
  EXPECT_EQ(world.boundary.planes[2].offset, 0.0);
}

}  // namespace
}  // namespace talus::dynamics
