/// Beds of some hundred grains at rest: forces balance, and the grain stresses agree with the forces on the
/// boundary.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/trigonometry.h"
#include "stress/stress.h"
#include "support/scenes.h"

namespace talus {
namespace {

constexpr double tolerance = 1e-8;

/// Returns a bed at rest, computed once and shared by the tests.
const World& bed_at_rest(bool periodic) {
  const auto settle = [](bool periodic) {
    return test::settled_bed(test::bed_plan(periodic, 240, 20, 7), test::bed_step(tolerance));
  };
  static const World with_period = settle(true), between_walls = settle(false);
  return periodic ? with_period : between_walls;
}

/// Returns the force on b at contact c, N.
Vec2 force(const Contacts& contacts, Index c) {
  return {contacts.fn[c] * contacts.nx[c] - contacts.ft[c] * contacts.ny[c],
          contacts.fn[c] * contacts.ny[c] + contacts.ft[c] * contacts.nx[c]};
}

/// Returns the sum of the contact forces on each free grain.
std::vector<Vec2> contact_forces(const World& world) {
  std::vector<Vec2> sum(static_cast<std::size_t>(world.grains.free_count));
  for (Index c = 0; c < world.contacts.count(); ++c) {
    const Vec2 f = force(world.contacts, c);
    const Index a = world.contacts.a[c];
    const Index b = world.contacts.b[c];
    sum[a].x -= f.x;
    sum[a].y -= f.y;
    if (b >= world.grains.free_count) continue;
    sum[b].x += f.x;
    sum[b].y += f.y;
  }
  return sum;
}

/// Returns the force of the free grains on floor and walls, N.
Vec2 force_on_boundary(const World& world) {
  Vec2 sum;
  for (Index c = 0; c < world.contacts.count(); ++c) {
    if (world.contacts.b[c] < world.grains.free_count) continue;
    sum.x += force(world.contacts, c).x;
    sum.y += force(world.contacts, c).y;
  }
  return sum;
}

/// Returns - sum over boundary contacts of r_i f_j - sum over free grains of r_i m g_j, with f and g acting
/// on the grains. `grains` are those of the midpoint, at which the contacts were found.
Tensor2 moment_of_outer_forces(const World& world, const Grains& grains) {
  Tensor2 sum;
  const auto add = [&](double x, double y, double fx, double fy) {
    sum.xx -= x * fx;
    sum.xy -= x * fy;
    sum.yx -= y * fx;
    sum.yy -= y * fy;
  };
  const Contacts& contacts = world.contacts;
  for (Index c = 0; c < contacts.count(); ++c) {
    if (contacts.b[c] < grains.free_count) continue;
    const Vec2 f = force(contacts, c);
    const Index a = contacts.a[c];
    add(grains.x[a] + grains.radius[a] * contacts.nx[c], grains.y[a] + grains.radius[a] * contacts.ny[c],
        -f.x, -f.y);
  }
  const Vec2 g = gravity_vector(world);
  for (Index i = 0; i < grains.free_count; ++i)
    add(grains.x[i], grains.y[i], grains.mass[i] * g.x, grains.mass[i] * g.y);
  return sum;
}

Tensor2 bed_moment(const World& world) {
  std::vector<Tensor2> moments;
  stress::internal_moments(world.grains, world.contacts, moments);
  return stress::sum_of_moments(moments, 0, world.grains.free_count);
}

/// Tilts a bed by 0.04 degrees per step and lets it come to rest.
void tilt_to(World& world, double angle, const dynamics::StepSettings& settings,
             dynamics::StepWorkspace& workspace) {
  while (world.tilt < angle) {
    world.tilt = std::min(angle, world.tilt + radians(0.04));
    dynamics::step(world, settings, workspace);
  }
  test::come_to_rest(world, settings, workspace);
}

class BedAtRest : public testing::TestWithParam<bool> {};

INSTANTIATE_TEST_SUITE_P(Beds, BedAtRest, testing::Values(true, false),
                         [](const auto& parameter) { return parameter.param ? "periodic" : "walled"; });

// m (v+ - v-) / h = sum f + m g holds for each grain to round-off, as an identity of the step; at rest the
// left side is the residual of the solver. The boundary carries the entire weight.
TEST_P(BedAtRest, balances) {
  const dynamics::StepSettings settings = test::bed_step(tolerance);
  World world = bed_at_rest(GetParam());
  const Grains before = world.grains;
  dynamics::StepWorkspace workspace;
  const dynamics::StepReport report = dynamics::step(world, settings, workspace);
  EXPECT_TRUE(report.solver.converged);

  const Vec2 g = gravity_vector(world);
  const double mean_weight = test::weight(world) / world.grains.free_count;
  const std::vector<Vec2> contact = contact_forces(world);
  double identity = 0.0, unbalanced = 0.0;
  for (Index i = 0; i < before.free_count; ++i) {
    const double mass = before.mass[i];
    const Vec2 net{contact[i].x + mass * g.x, contact[i].y + mass * g.y};
    identity = std::max({identity, std::fabs(mass * (world.grains.vx[i] - before.vx[i]) / settings.h - net.x),
                         std::fabs(mass * (world.grains.vy[i] - before.vy[i]) / settings.h - net.y)});
    unbalanced = std::max(unbalanced, std::hypot(net.x, net.y));
  }
  EXPECT_LT(identity, 1e-10 * mean_weight);
  EXPECT_LT(unbalanced, 1e-5 * mean_weight);

  const Vec2 carried = force_on_boundary(world);
  EXPECT_NEAR(carried.y, -test::weight(world), 1e-6 * test::weight(world));
  EXPECT_NEAR(carried.x, 0.0, 1e-6 * test::weight(world));
}

// The sum of the grain stresses is the moment of the external forces, because internal forces act at one
// point on two grains. Across the periodic edge this holds only for the y row, whose lever arms do not jump
// there. The difference is due to the residual of the solver and to closed gaps.
TEST_P(BedAtRest, grain_stresses_add_up_to_the_moment_of_the_outer_forces) {
  const dynamics::StepSettings settings = test::bed_step(tolerance);
  World world = bed_at_rest(GetParam());
  Grains midpoint = world.grains;
  for (Index i = 0; i < midpoint.free_count; ++i) {
    midpoint.x[i] += 0.5 * settings.h * midpoint.vx[i];
    midpoint.y[i] += 0.5 * settings.h * midpoint.vy[i];
  }
  dynamics::StepWorkspace workspace;
  dynamics::step(world, settings, workspace);
  const Tensor2 sum = bed_moment(world);
  const Tensor2 outer = moment_of_outer_forces(world, midpoint);
  const double scale = sum.yy;
  EXPECT_GT(scale, 0.0);
  EXPECT_NEAR(sum.yy, outer.yy, 1e-5 * scale);
  EXPECT_NEAR(sum.yx, outer.yx, 1e-5 * scale);
  if (!GetParam()) {
    EXPECT_NEAR(sum.xx, outer.xx, 1e-5 * scale);
    EXPECT_NEAR(sum.xy, outer.xy, 1e-5 * scale);
  }
}

// On each level of a periodic bed the weight above gives shear and pressure in the ratio tan(theta), so their
// sums have this ratio too, except for the lower half of the lowest layer. M_yx is negative because y points
// out of the bed.
TEST(PeriodicBed, shear_over_normal_stress_is_the_tangent_of_the_tilt) {
  const dynamics::StepSettings settings = test::bed_step(tolerance);
  World world = bed_at_rest(true);
  dynamics::StepWorkspace workspace;
  for (double angle : {1.0, 2.0, 4.0}) {
    tilt_to(world, radians(angle), settings, workspace);
    const double weight = test::weight(world);
    const Vec2 carried = force_on_boundary(world);
    EXPECT_NEAR(carried.x, weight * sine(world.tilt), 1e-3 * weight);
    EXPECT_NEAR(carried.y, -weight * cosine(world.tilt), 1e-3 * weight);
    const Tensor2 sum = bed_moment(world);
    const double ratio = -sum.yx / sum.yy / std::tan(world.tilt);
    EXPECT_NEAR(ratio, 1.0, 0.02) << angle << " degrees";
    EXPECT_NEAR(sum.xy, sum.yx, 1e-3 * sum.yy);
  }
}

}  // namespace
}  // namespace talus
