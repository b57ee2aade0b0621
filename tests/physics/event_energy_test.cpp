/// Compares two energies of a rearrangement: the one that the catalogue of events derives from the
/// displacements of the grains, and the work dissipated by the contacts, P . (U- + U+) / 2 in each step, plus
/// the remaining kinetic energy.

#include <gtest/gtest.h>

#include "analysis/events/events.h"
#include "support/scenes.h"

namespace talus {
namespace {

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

}  // namespace
}  // namespace talus
