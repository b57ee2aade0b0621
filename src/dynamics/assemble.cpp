#include "dynamics/assemble.h"

#include <algorithm>

namespace talus {
namespace {

void assemble_bodies(const World& world, double h, ContactProblem& problem) {
  const Grains& grains = world.grains;
  const auto count = static_cast<std::size_t>(grains.count());
  const std::size_t bodies = count + world.boundary.planes.size();
  for (auto* field : {&problem.vx, &problem.vy, &problem.omega, &problem.inverse_mass,
                      &problem.inverse_inertia, &problem.lever})
    field->resize(bodies);
  const Vec2 gravity = gravity_vector(world);
  for (std::size_t i = 0; i < count; ++i) {
    const bool moves = grains.inverse_mass[i] > 0.0;
    problem.vx[i] = moves ? grains.vx[i] + h * gravity.x : 0.0;
    problem.vy[i] = moves ? grains.vy[i] + h * gravity.y : 0.0;
    problem.omega[i] = grains.omega[i];
    problem.inverse_mass[i] = grains.inverse_mass[i];
    problem.inverse_inertia[i] = grains.inverse_inertia[i];
    problem.lever[i] = grains.radius[i];
  }
  for (std::size_t i = count; i < bodies; ++i)
    problem.vx[i] = problem.vy[i] = problem.omega[i] = problem.inverse_mass[i] = problem.inverse_inertia[i] =
        problem.lever[i] = 0.0;
}

/// Relative velocity at contact c before the step.
RelativeVelocity velocity_before(const Grains& grains, const Contacts& contacts, Index c) {
  const Index a = contacts.a[c];
  const Index b = contacts.b[c];
  const bool plane = b >= grains.count();
  const double dvx = (plane ? 0.0 : grains.vx[b]) - grains.vx[a];
  const double dvy = (plane ? 0.0 : grains.vy[b]) - grains.vy[a];
  const double spin = grains.radius[a] * grains.omega[a] + (plane ? 0.0 : grains.radius[b] * grains.omega[b]);
  return {dvx * contacts.nx[c] + dvy * contacts.ny[c], dvy * contacts.nx[c] - dvx * contacts.ny[c] - spin};
}

double free_normal_velocity(const ContactProblem& problem, Index c) {
  const Index a = problem.a[c];
  const Index b = problem.b[c];
  return (problem.vx[b] - problem.vx[a]) * problem.nx[c] + (problem.vy[b] - problem.vy[a]) * problem.ny[c];
}

void assemble_contact(const World& world, const Contacts& contacts, const ContactLawParameters& law, double h,
                      Index c, ContactProblem& problem) {
  const double gap = contacts.gap[c];
  problem.cn[c] = gap > 0.0 ? gap / h : law.overlap_correction * gap / h;
  problem.ct[c] = 0.0;
  if (law.restitution == 0.0 && law.tangential_restitution == 0.0) return;
  const bool closes = gap + h * free_normal_velocity(problem, c) <= 0.0;
  if (!closes) return;
  const RelativeVelocity before = velocity_before(world.grains, contacts, c);
  if (before.normal < 0.0) problem.cn[c] = std::min(problem.cn[c], law.restitution * before.normal);
  problem.ct[c] = law.tangential_restitution * before.tangential;
}

}  // namespace

void assemble(const World& world, const Contacts& contacts, const ContactLawParameters& law, double h,
              ContactProblem& problem) {
  assemble_bodies(world, h, problem);
  const auto count = static_cast<std::size_t>(contacts.count());
  problem.a = contacts.a;
  problem.b = contacts.b;
  problem.nx = contacts.nx;
  problem.ny = contacts.ny;
  problem.cn.resize(count);
  problem.ct.resize(count);
  problem.mu.resize(count);
  for (Index c = 0; c < contacts.count(); ++c) {
    const Index plane = contacts.b[c] - world.grains.count();
    const bool wall = plane >= 0 && world.boundary.planes[static_cast<std::size_t>(plane)].wall;
    problem.mu[c] = wall ? law.wall_friction : law.friction;
    assemble_contact(world, contacts, law, h, c, problem);
  }
}

}  // namespace talus
