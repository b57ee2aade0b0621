/// Energy balance of the scheme. With P the impulses of a step, v- + h g the free velocity and e = 0,
/// Signorini and Coulomb give K(v+) - K(v- + h g) = P . U+ - P . W P / 2 <= 0. Because positions follow (v- +
/// v+) / 2, potential energy takes exactly the work of gravity, and the total energy increases by at most - w
/// . M w / 2 - (h / 2) w . M g, with w = M^-1 H P: never more than m (g h)^2 / 8 per grain and step, and not
/// at all without gravity. Compares two energies of a rearrangement: the one that the catalogue of events
/// derives from the displacements of the grains, and the work dissipated by the contacts, P . (U- + U+) / 2
/// in each step, plus the remaining kinetic energy. Beds whose contacts resist rolling (T38): the laws of
/// friction hold for moments too.

#include <gtest/gtest.h>

#include <algorithm>

#include "analysis/events/events.h"
#include "dynamics/bed.h"
#include "support/scenes.h"

namespace talus {
namespace {

/// Returns the kinetic energy of the free grains after free fall over one step.
double free_energy(const World& world, double h) {
  Grains free = world.grains;
  const Vec2 g = gravity_vector(world);
  for (Index i = 0; i < free.free_count; ++i) {
    free.vx[i] += h * g.x;
    free.vy[i] += h * g.y;
  }
  return kinetic_energy(free);
}

/// Lets a bed fall and come to rest; its energy must not grow.
void expect_no_growth(const dynamics::StepSettings& settings, bool periodic) {
  World world = dynamics::make_loose_bed(test::bed_plan(periodic, 120, 12, 3), 0.4);
  world.tilt = 0.1;
  const double start = test::mechanical_energy(world);
  const double quantum = test::weight(world) * world.gravity * settings.h * settings.h / 8.0;
  const double solver_error = 1e-9 * test::weight(world) * dynamics::BedPlan{}.mean_diameter;
  dynamics::StepWorkspace workspace;
  double energy = start;
  for (int k = 0; k < 500; ++k) {
    const double before = free_energy(world, settings.h);
    dynamics::step(world, settings, workspace);
    if (settings.law.restitution == 0.0) {
      EXPECT_LE(kinetic_energy(world.grains), before + solver_error) << k;
    }
    const double now = test::mechanical_energy(world);
    EXPECT_LE(now, energy + quantum + solver_error) << k;
    EXPECT_LE(now, start + solver_error) << k;
    energy = now;
  }
  EXPECT_LT(energy, start - 0.2 * test::weight(world) * dynamics::BedPlan{}.mean_diameter) << "nothing fell";
}

class Energy : public testing::TestWithParam<bool> {};

INSTANTIATE_TEST_SUITE_P(Beds, Energy, testing::Values(true, false),
                         [](const auto& parameter) { return parameter.param ? "periodic" : "walled"; });

TEST_P(Energy, never_grows_while_a_bed_falls_and_comes_to_rest) {
  expect_no_growth(test::bed_step(1e-8), GetParam());
}

TEST_P(Energy, never_grows_with_restitution) {
  dynamics::StepSettings settings = test::bed_step(1e-8);
  settings.law.restitution = 0.5;
  expect_no_growth(settings, GetParam());
}

Frame frame_of(const World& world) {
  Frame frame;
  frame.image = world.grains.image;
  frame.x = world.grains.x;
  frame.y = world.grains.y;
  return frame;
}

/// Returns the velocity of a body at its contact, along n and t; `arm` is its radius, negative if n points
/// towards the body.
Vec2 at_contact(const Grains& grains, Index body, double nx, double ny, double arm) {
  if (body >= grains.count()) return {};
  const double vx = grains.vx[body], vy = grains.vy[body];
  return {vx * nx + vy * ny, vy * nx - vx * ny + grains.omega[body] * arm};
}

/// Returns the power of the contact forces of a step at the velocities of `grains`, W/m.
double contact_power(const Grains& grains, const Contacts& contacts) {
  double power = 0.0;
  for (Index c = 0; c < contacts.count(); ++c) {
    const double nx = contacts.nx[c], ny = contacts.ny[c];
    const auto arm = [&](Index body) { return body < grains.count() ? grains.radius[body] : 0.0; };
    const Vec2 a = at_contact(grains, contacts.a[c], nx, ny, arm(contacts.a[c]));
    const Vec2 b = at_contact(grains, contacts.b[c], nx, ny, -arm(contacts.b[c]));
    power += contacts.fn[c] * (b.x - a.x) + contacts.ft[c] * (b.y - a.y);
  }
  return power;
}

class EventEnergy : public testing::TestWithParam<bool> {};

INSTANTIATE_TEST_SUITE_P(Beds, EventEnergy, testing::Values(true, false),
                         [](const auto& parameter) { return parameter.param ? "periodic" : "walled"; });

TEST_P(EventEnergy, is_what_contacts_dissipate_and_motion_keeps) {
  const dynamics::StepSettings settings = test::bed_step(1e-8);
  World world = test::fallen_bed(test::bed_plan(GetParam(), 120, 12, 5), settings, 40);
  world.tilt = 0.5;
  RunStatics statics;
  statics.free_count = world.grains.free_count;
  statics.mass = world.grains.mass;
  statics.periodic = world.boundary.periodic;
  statics.length = world.boundary.length;
  statics.gravity = world.gravity;
  dynamics::StepWorkspace workspace;
  double released = 0.0, dissipated = 0.0;
  const double motion = kinetic_energy(world.grains);
  Frame before = frame_of(world);
  for (int k = 1; k <= 200; ++k) {
    const Grains old = world.grains;
    dynamics::step(world, settings, workspace);
    dissipated -=
        0.5 * settings.h * (contact_power(old, world.contacts) + contact_power(world.grains, world.contacts));
    if (k % 20 != 0) continue;  // only frames
    const Frame after = frame_of(world);
    released +=
        analysis::gravity_work(statics, analysis::mean_displacement(before, after, statics), world.tilt);
    before = after;
  }
  const double kept = kinetic_energy(world.grains) - motion;
  EXPECT_GT(dissipated, 0.2 * test::weight(world) * dynamics::BedPlan{}.mean_diameter) << "nothing happened";
  EXPECT_NEAR(released, dissipated + kept, 1e-9 * released);
}

dynamics::StepSettings settings_with(double rolling_friction, double tolerance) {
  dynamics::StepSettings settings = test::bed_step(tolerance);
  settings.law.rolling_friction = rolling_friction;
  return settings;
}

// P_r U_r <= 0 holds too.
TEST(RollingBed, energy_never_grows) { expect_no_growth(settings_with(0.2, 1e-8), true); }

// The moments are part of the state: without them the next step differs, and so does the hash.
TEST(RollingBed, remembers_its_moments) {
  const dynamics::StepSettings settings = settings_with(0.2, 1e-6);
  World world = test::settled_bed(test::bed_plan(true, 60, 10, 4), settings);
  World copy = world, without = world;
  std::ranges::fill(without.contacts.moment, 0.0);
  EXPECT_NE(state_hash(without), state_hash(world));
  dynamics::StepWorkspace first, second, third;
  const int iterations = dynamics::step(world, settings, first).solver.iterations;
  dynamics::step(copy, settings, second);
  const int more = dynamics::step(without, settings, third).solver.iterations;
  EXPECT_EQ(state_hash(copy), state_hash(world));
  EXPECT_LT(iterations, more);
}

}  // namespace
}  // namespace talus
