#include "dynamics/form_problem.h"

#include <algorithm>
#include <cmath>

namespace talus::dynamics {
namespace {

/// Contacts first ... last - 1, the part of one member of a team.
struct Part {
  std::size_t first, last;
};

template <typename Value>
void copy(const std::vector<Value>& from, Part part, std::vector<Value>& to) {
  std::copy(from.data() + part.first, from.data() + part.last, to.data() + part.first);
}

void fill(std::vector<double>& values, Part part, double value) {
  std::fill(values.data() + part.first, values.data() + part.last, value);
}

/// Sizes the arrays of bodies, including the planes, which never move.
void size_bodies(const World& world, solver::ContactProblem& problem) {
  const auto grains = static_cast<std::size_t>(world.grains.count());
  for (auto* field : {&problem.vx, &problem.vy, &problem.omega, &problem.inverse_mass,
                      &problem.inverse_inertia, &problem.lever}) {
    field->resize(grains);
    field->resize(grains + world.boundary.planes.size(), 0.0);
  }
}

/// Copies the grains: free velocities, and the masses, inertias and radii of the Delassus operator (T8).
void take_grains(const World& world, double h, solver::ContactProblem& problem) {
  const Grains& grains = world.grains;
  const Part all{0, static_cast<std::size_t>(grains.count())};
  const Vec2 gravity = gravity_vector(world);
  const Vec2 fall{h * gravity.x, h * gravity.y};
  for (std::size_t i = all.first; i < all.last; ++i) {
    const bool moves = grains.inverse_mass[i] > 0.0;
    const double vx = grains.vx[i] + fall.x;  // (T4)
    const double vy = grains.vy[i] + fall.y;
    problem.vx[i] = moves ? vx : 0.0;
    problem.vy[i] = moves ? vy : 0.0;
  }
  copy(grains.omega, all, problem.omega);
  copy(grains.inverse_mass, all, problem.inverse_mass);
  copy(grains.inverse_inertia, all, problem.inverse_inertia);
  copy(grains.radius, all, problem.lever);
}

/// Returns the number of columns of a bed with this number of contacts.
Index columns_of(const World& world, Index contacts) {
  constexpr Index contacts_for_columns = 24'000;
  constexpr double width_of_column = 4.0;  // in diameters of the largest grain
  if (contacts < contacts_for_columns) return 0;
  const std::vector<double>& radius = world.grains.radius;
  const double largest = 2.0 * *std::max_element(radius.begin(), radius.end());
  const double columns = std::floor(world.boundary.length / (width_of_column * largest));
  return columns >= 1.0 ? static_cast<Index>(std::min(columns, static_cast<double>(radius.size()))) : 0;
}

void size_columns(const World& world, Index contacts, solver::ContactProblem& problem) {
  problem.columns = columns_of(world, contacts);
  problem.column.resize(problem.columns > 0 ? problem.vx.size() : 0);
}

void take_columns(const World& world, solver::ContactProblem& problem) {
  if (problem.columns == 0) return;
  const std::vector<double>& x = world.grains.x;
  const double last = problem.columns - 1.0, columns_per_metre = problem.columns / world.boundary.length;
  for (std::size_t i = 0; i < x.size(); ++i) {
    // A position of NaN gets column 0, so that the step can detect and report it.
    const double at = x[i] * columns_per_metre;
    problem.column[i] = at > 0.0 ? static_cast<Index>(std::min(at, last)) : 0;
  }
  std::fill(problem.column.begin() + static_cast<std::ptrdiff_t>(x.size()), problem.column.end(),
            0);  // planes
}

/// Sizes the arrays of contacts. Assignments would allocate each time that the number of contacts grows.
void size_contacts(const Contacts& contacts, const ContactLawParameters& law,
                   solver::ContactProblem& problem) {
  const std::size_t count = contacts.a.size();
  for (auto* field : {&problem.a, &problem.b}) field->resize(count);
  for (auto* field : {&problem.nx, &problem.ny, &problem.cn, &problem.ct, &problem.mu}) field->resize(count);
  problem.rolling_friction.resize(law.rolling_friction != 0.0 ? count : 0);
}

void take_local_frames(const Contacts& contacts, Part part, solver::ContactProblem& problem) {
  copy(contacts.a, part, problem.a);
  copy(contacts.b, part, problem.b);
  copy(contacts.nx, part, problem.nx);
  copy(contacts.ny, part, problem.ny);
}

/// Returns the relative velocity at contact c before the step.
solver::RelativeVelocity velocity_before(const Grains& grains, const Contacts& contacts, Index c) {
  const Index a = contacts.a[c];
  const Index b = contacts.b[c];
  const bool plane = b >= grains.count();
  const double dvx = (plane ? 0.0 : grains.vx[b]) - grains.vx[a];
  const double dvy = (plane ? 0.0 : grains.vy[b]) - grains.vy[a];
  const double spin = grains.radius[a] * grains.omega[a] + (plane ? 0.0 : grains.radius[b] * grains.omega[b]);
  return {dvx * contacts.nx[c] + dvy * contacts.ny[c], dvy * contacts.nx[c] - dvx * contacts.ny[c] - spin};
}

double free_normal_velocity(const solver::ContactProblem& problem, Index c) {
  const Index a = problem.a[c];
  const Index b = problem.b[c];
  return (problem.vx[b] - problem.vx[a]) * problem.nx[c] + (problem.vy[b] - problem.vy[a]) * problem.ny[c];
}

/// Returns the error of an impulse that the tolerance of a solve allows: the tolerance times the rms of the
/// remembered impulses.
double impulse_of_noise(const Contacts& contacts, double h, double tolerance) {
  double sum = 0.0;
  Index bearing = 0;
  for (Index c = 0; c < contacts.count(); ++c) {
    const double fn = contacts.fn[c], ft = contacts.ft[c];
    sum += fn * fn + ft * ft;
    bearing += fn > 0.0 ? 1 : 0;
  }
  return bearing > 0 ? tolerance * h * std::sqrt(sum / bearing) : 0.0;
}

/// Sets c_n by (T11). A gap or an overlap of a contact that bears load is an error of the solver. Correcting
/// all of them at once would demand velocities of closed loops of contacts that no motion of rigid bodies
/// has: forces would drift along self-stresses, and the solve would not converge. They are therefore
/// corrected no faster than they arise.
void set_gap_velocities(const Contacts& contacts, const ContactLawParameters& law, double h, double noise,
                        Part part, solver::ContactProblem& problem) {
  const double allowed = law.allowed_overlap, share = law.overlap_correction;
  // Larger gaps and overlaps are not noise. The limit of gaps is small, because gaps also open when grains
  // move past each other.
  const double gap_of_noise = 0.05 * allowed, overlap_of_noise = 10.0 * allowed;
  for (std::size_t c = part.first; c < part.last; ++c) {
    const double gap = contacts.gap[c], overlap = -gap;
    double& cn = problem.cn[c];
    if (gap > 0.0 ? contacts.fn[c] == 0.0 : overlap <= allowed) {
      cn = std::max(0.0, gap) / h;
      continue;
    }
    const double slowly = noise * solver::delassus_diagonal(problem, static_cast<Index>(c)).normal;
    if (gap > 0.0)
      cn = std::max(std::min(gap / h, slowly), (gap - gap_of_noise) / h);
    else
      cn = -std::max(std::min(share * ((overlap - allowed) / h), slowly),
                     share * ((overlap - overlap_of_noise) / h));
  }
}

/// Applies restitution (T12).
void set_restitution(const World& world, const Contacts& contacts, const ContactLawParameters& law, double h,
                     solver::ContactProblem& problem) {
  for (Index c = 0; c < contacts.count(); ++c) {
    const bool closes = contacts.gap[c] + h * free_normal_velocity(problem, c) <= 0.0;
    if (!closes) continue;
    const solver::RelativeVelocity before = velocity_before(world.grains, contacts, c);
    if (before.normal < 0.0) problem.cn[c] = std::min(problem.cn[c], law.restitution * before.normal);
    problem.ct[c] = law.tangential_restitution * before.tangential;
  }
}

bool touches_wall(const World& world, const Contacts& contacts, std::size_t c) {
  const Index plane = contacts.b[c] - world.grains.count();
  return plane >= 0 && world.boundary.planes[static_cast<std::size_t>(plane)].wall;
}

void set_friction(const World& world, const Contacts& contacts, const ContactLawParameters& law, Part part,
                  solver::ContactProblem& problem) {
  fill(problem.mu, part, law.friction);
  if (world.boundary.planes.empty()) return;
  for (std::size_t c = part.first; c < part.last; ++c)
    if (touches_wall(world, contacts, c)) problem.mu[c] = law.wall_friction;
}

/// Sets mu_r. Side walls do not resist rolling.
void set_rolling_friction(const World& world, const Contacts& contacts, const ContactLawParameters& law,
                          Part part, solver::ContactProblem& problem) {
  if (law.rolling_friction == 0.0) return;
  fill(problem.rolling_friction, part, law.rolling_friction);
  for (std::size_t c = part.first; c < part.last; ++c)
    if (touches_wall(world, contacts, c)) problem.rolling_friction[c] = 0.0;
}

}  // namespace

void form_problem(const World& world, const Contacts& contacts, const ContactLawParameters& law, double h,
                  double tolerance, solver::ContactProblem& problem, ThreadTeam* team) {
  size_bodies(world, problem);
  size_contacts(contacts, law, problem);
  size_columns(world, contacts.count(), problem);
  double noise = 0.0;
  // The sum of the noise is one chain of additions, in an order that must not depend on the team.
  run_both(
      team, [&] { noise = impulse_of_noise(contacts, h, tolerance); },
      [&] {
        take_grains(world, h, problem);
        take_columns(world, problem);
      });
  distribute(team, contacts.a.size(), [&](std::size_t first, std::size_t last) {
    const Part part{first, last};
    take_local_frames(contacts, part, problem);
    set_gap_velocities(contacts, law, h, noise, part, problem);
    fill(problem.ct, part, 0.0);
    set_friction(world, contacts, law, part, problem);
    set_rolling_friction(world, contacts, law, part, problem);
  });
  if (law.restitution != 0.0 || law.tangential_restitution != 0.0)
    set_restitution(world, contacts, law, h, problem);
}

}  // namespace talus::dynamics
