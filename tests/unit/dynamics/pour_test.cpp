#include <gtest/gtest.h>

#include <algorithm>

#include "dynamics/bed.h"
#include "dynamics/step.h"
#include "support/scenes.h"

namespace talus::dynamics {
namespace {

constexpr PourRule rule{.speed = 2.0, .interval = 0.01, .density = 2500.0};
constexpr double h = 1e-3;

BedPlan plan_of(bool periodic, bool rough, Index count = 100) {
  BedPlan plan;
  plan.length = 10.0 * plan.mean_diameter;
  plan.grain_count = count;
  plan.periodic = periodic;
  plan.rough_floor = rough;
  return plan;
}

World bare_floor(const BedPlan& plan) {
  World world = empty_bed(plan);
  add_floor(plan, world);
  return world;
}

std::pair<std::vector<Arrival>, World> before_pouring(const BedPlan& plan) {
  return {pour_arrivals(plan), bare_floor(plan)};
}

TEST(PourArrivals, have_sizes_and_places_in_range_all_along_the_bed) {
  for (const bool periodic : {true, false}) {
    const BedPlan plan = plan_of(periodic, true, 2000);
    const std::vector<Arrival> arrivals = pour_arrivals(plan);
    ASSERT_EQ(arrivals.size(), 2000u);
    double low = plan.length, high = 0.0, small = 1.0, large = 0.0;
    for (const auto& [radius, x] : arrivals) {
      const double margin = periodic ? 0.0 : radius;
      EXPECT_GE(x, margin);
      EXPECT_LE(x, plan.length - margin);
      low = std::min(low, x - margin);
      high = std::max(high, x + margin);
      small = std::min(small, 2.0 * radius);
      large = std::max(large, 2.0 * radius);
    }
    EXPECT_LT(low, 0.01 * plan.length);
    EXPECT_GT(high, 0.99 * plan.length);
    EXPECT_GE(small, smallest_diameter(plan));
    EXPECT_LT(small, 1.01 * smallest_diameter(plan));
    EXPECT_LE(large, largest_diameter(plan));
    EXPECT_GT(large, 0.99 * largest_diameter(plan));
  }
}

TEST(PourArrivals, are_the_same_for_the_same_plan_and_others_for_another_seed) {
  const BedPlan plan = plan_of(true, true);
  BedPlan other = plan;
  other.seed = 2;
  const auto x_of = [](const BedPlan& p, std::size_t i) { return pour_arrivals(p)[i].x; };
  for (const std::size_t i : {0u, 50u, 99u}) {
    EXPECT_EQ(x_of(plan, i), x_of(plan, i));
    EXPECT_NE(x_of(plan, i), x_of(other, i));
  }
}

TEST(ArrivedBy, counts_the_first_grain_at_time_0_and_one_more_after_each_interval) {
  const PourRule quarter{.speed = 0.0, .interval = 0.25, .density = 1.0};
  EXPECT_EQ(arrived_by(0.0, quarter, 10), 1);
  EXPECT_EQ(arrived_by(0.2499, quarter, 10), 1);
  EXPECT_EQ(arrived_by(0.25, quarter, 10), 2);
  EXPECT_EQ(arrived_by(2.2499, quarter, 10), 9);
  EXPECT_EQ(arrived_by(2.25, quarter, 10), 10);
  EXPECT_EQ(arrived_by(1e300, quarter, 10), 10);
  EXPECT_EQ(arrived_by(0.0, quarter, 0), 0);
}

// After a further fall of half a step the grain touches a body, and none before: the heights follow from the
// first body on each vertical line.
TEST(LetArrive, a_grain_stands_half_a_step_of_its_fall_above_what_it_touches_first) {
  for (const bool periodic : {true, false})
    for (const bool rough : {true, false}) {
      const BedPlan plan = plan_of(periodic, rough, 60);
      auto [arrivals, world] = before_pouring(plan);
      for (Index i = 0; i < plan.grain_count; ++i) {
        world.time = (i + 0.5) * rule.interval;
        add_due_grains(arrivals, rule, h, world);
        ASSERT_EQ(world.grains.free_count, i + 1);
        EXPECT_EQ(world.grains.x[i], arrivals[static_cast<std::size_t>(i)].x);
        EXPECT_EQ(world.grains.radius[i], arrivals[static_cast<std::size_t>(i)].radius);
        EXPECT_EQ(world.grains.vy[i], -rule.speed);
        EXPECT_EQ(world.grains.vx[i], 0.0);
        EXPECT_GE(test::smallest_gap(world, i), -1e-16);
        world.grains.y[i] -= 0.5 * h * rule.speed;
        EXPECT_NEAR(test::smallest_gap(world, i), 0.0, 1e-15) << "grain " << i;
      }
    }
}

TEST(LetArrive, those_that_are_due_together_do_not_overlap) {
  const BedPlan plan = plan_of(true, true, 60);
  auto [arrivals, world] = before_pouring(plan);
  world.time = 59.5 * rule.interval;
  add_due_grains(arrivals, rule, h, world);
  ASSERT_EQ(world.grains.free_count, 60);
  for (Index i = 0; i < 60; ++i) EXPECT_GE(test::smallest_gap(world, i), -1e-16);
}

TEST(LetArrive, does_nothing_before_the_next_is_due_and_after_the_last) {
  const BedPlan plan = plan_of(true, true, 2);
  auto [arrivals, world] = before_pouring(plan);
  add_due_grains(arrivals, rule, h, world);
  const std::uint64_t with_one = state_hash(world);
  add_due_grains(arrivals, rule, h, world);
  EXPECT_EQ(state_hash(world), with_one);
  world.time = 1.0;
  add_due_grains(arrivals, rule, h, world);
  world.time = 2.0;
  add_due_grains(arrivals, rule, h, world);
  EXPECT_EQ(world.grains.free_count, 2);
}

TEST(LetArrive, ids_of_floor_and_planes_move_up_and_forces_stay) {
  const BedPlan plan = plan_of(false, true, 3);  // 10 floor grains, followed by planes 10 and 11
  auto [arrivals, world] = before_pouring(plan);
  add_due_grains(arrivals, rule, h, world);
  world.contacts.resize(3);  // the first grain on a floor grain, and at each wall
  world.contacts.a = {0, 0, 0};
  world.contacts.b = {4, 11, 12};
  world.contacts.fn = {3.0, 1.0, 2.0};
  world.contacts.ft = {0.5, -0.5, 0.25};
  const double floor_x = world.grains.x[4];
  world.time = 1.0;
  add_due_grains(arrivals, rule, h, world);
  EXPECT_EQ(world.grains.free_count, 3);
  EXPECT_EQ(world.contacts.a, (std::vector<Index>{0, 0, 0}));
  EXPECT_EQ(world.contacts.b, (std::vector<Index>{6, 13, 14}));
  EXPECT_EQ(world.contacts.fn, (std::vector<double>{3.0, 1.0, 2.0}));
  EXPECT_EQ(world.contacts.ft, (std::vector<double>{0.5, -0.5, 0.25}));
  EXPECT_EQ(world.grains.x[6], floor_x);
  EXPECT_EQ(world.grains.inverse_mass[6], 0.0);
  EXPECT_GT(world.grains.inverse_mass[2], 0.0);
}

TEST(WithAllArrivals, lists_those_on_their_way_behind_the_free_grains) {
  const BedPlan plan = plan_of(true, true, 5);
  auto [arrivals, world] = before_pouring(plan);
  world.time = 1.5 * rule.interval;
  add_due_grains(arrivals, rule, h, world);
  const Grains all = with_remaining_grains(world.grains, arrivals, rule.density);
  EXPECT_EQ(world.grains.free_count, 2);
  EXPECT_EQ(all.free_count, 5);
  EXPECT_EQ(all.count(), 15);
  for (Index i = 0; i < 5; ++i) EXPECT_EQ(all.radius[i], arrivals[static_cast<std::size_t>(i)].radius);
  EXPECT_EQ(all.mass[1], world.grains.mass[1]);
  EXPECT_EQ(all.x[5], world.grains.x[2]);
  EXPECT_EQ(with_remaining_grains(world.grains, {}, rule.density).count(),
            12);  // for a bed that is not poured
}

// The grain touches at the midpoint of the step: the plane stops it at once, and it stays on the plane.
TEST(Pour, a_grain_that_arrives_touches_in_its_first_step) {
  const BedPlan plan = plan_of(true, false, 1);
  auto [arrivals, world] = before_pouring(plan);
  StepWorkspace workspace;
  add_due_grains(arrivals, rule, 1e-3, world);
  step(world, test::exact_step(solver::SolverKind::accelerated), workspace);
  EXPECT_NEAR(world.grains.vy[0], 0.0, 1e-9);
  EXPECT_NEAR(world.grains.y[0], world.grains.radius[0], 1e-9);
}

}  // namespace
}  // namespace talus::dynamics
