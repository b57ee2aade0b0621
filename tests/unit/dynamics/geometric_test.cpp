#include "dynamics/geometric.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "core/trigonometry.h"

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

}  // namespace
}  // namespace talus::dynamics
