#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/detection.h"
#include "core/random.h"
#include "dynamics/bed.h"
#include "dynamics/step.h"

namespace talus::test {
namespace {

constexpr double loose_fraction = 0.4;

}  // namespace

std::string name_of(solver::SolverKind kind) {
  return kind == solver::SolverKind::gauss_seidel ? "gauss_seidel" : "accelerated";
}

dynamics::StepSettings exact_step(solver::SolverKind kind, double friction) {
  dynamics::StepSettings settings;
  settings.h = time_step;
  settings.margin = 0.02 * radius;
  settings.law.friction = settings.law.wall_friction = friction;
  settings.solver.kind = kind;
  settings.solver.tolerance = 1e-14;
  settings.solver.max_iterations = 5000;
  return settings;
}

dynamics::StepSettings bed_step(double tolerance, double friction) {
  dynamics::StepSettings settings;
  settings.h = time_step;
  settings.margin = 0.02 * dynamics::BedPlan{}.mean_diameter;
  settings.law.friction = settings.law.wall_friction = friction;
  settings.law.allowed_overlap = 1e-4 * dynamics::BedPlan{}.mean_diameter;
  settings.solver.tolerance = tolerance;
  return settings;
}

World disk_on_plane(double tilt) {
  World world;
  world.tilt = tilt;
  world.boundary.length = 1.0;
  world.boundary.planes.push_back({.normal = {0.0, 1.0}, .offset = 0.0, .wall = false});
  add_disk(world.grains, {0.1, radius}, radius, density, false);
  return world;
}

World two_disks(double angle, Vec2 velocity_a, Vec2 velocity_b, double radius_a, double radius_b) {
  World world;
  world.gravity = 0.0;
  world.boundary.length = 1.0;
  const Vec2 normal{std::cos(angle), std::sin(angle)};
  const double distance = radius_a + radius_b;
  const Vec2 centre{0.5, 0.5};
  const double back = 0.5 * time_step;
  add_disk(world.grains, {centre.x - back * velocity_a.x, centre.y - back * velocity_a.y}, radius_a, density,
           false);
  add_disk(world.grains,
           {centre.x + distance * normal.x - back * velocity_b.x,
            centre.y + distance * normal.y - back * velocity_b.y},
           radius_b, density, false);
  world.grains.vx = {velocity_a.x, velocity_b.x};
  world.grains.vy = {velocity_a.y, velocity_b.y};
  return world;
}

World column(Index count) {
  World world = disk_on_plane(0.0);
  for (Index i = 1; i < count; ++i)
    add_disk(world.grains, {0.1, (2.0 * i + 1.0) * radius}, radius, density, false);
  return world;
}

World random_cloud(std::uint64_t seed, Index count, bool periodic, double length) {
  World world;
  world.gravity = 0.0;
  world.boundary.periodic = periodic;
  world.boundary.length = length;
  Random random(seed);
  for (Index i = 0; i < count; ++i) {
    const Vec2 centre{random.uniform(0.0, length), random.uniform(0.0, length)};
    add_disk(world.grains, centre, radius * random.uniform(0.8, 1.2), density, false);
    world.grains.vx[i] = random.uniform(-1.0, 1.0);
    world.grains.vy[i] = random.uniform(-1.0, 1.0);
    world.grains.omega[i] = random.uniform(-1.0, 1.0) / radius;
  }
  return world;
}

dynamics::BedPlan bed_plan(bool periodic, Index count, Index columns, std::uint64_t seed) {
  dynamics::BedPlan plan;
  plan.length = columns * plan.mean_diameter;
  plan.grain_count = count;
  plan.periodic = periodic;
  plan.seed = seed;
  return plan;
}

World fallen_bed(const dynamics::BedPlan& plan, const dynamics::StepSettings& settings, int steps) {
  World world = dynamics::make_loose_bed(plan, loose_fraction);
  dynamics::StepWorkspace workspace;
  for (int k = 0; k < steps; ++k) dynamics::step(world, settings, workspace);
  return world;
}

void come_to_rest(World& world, const dynamics::StepSettings& settings, dynamics::StepWorkspace& workspace) {
  const double still = 1e-3 * world.gravity * settings.h;
  int quiet = 0;
  for (int k = 0; quiet < 50 && k < 10000; ++k)
    quiet = dynamics::step(world, settings, workspace).motion.rms_velocity <= still ? quiet + 1 : 0;
  EXPECT_EQ(quiet, 50) << "the world did not come to rest: " << rms_velocity(world.grains);
}

World settled_bed(const dynamics::BedPlan& plan, const dynamics::StepSettings& settings) {
  World world = dynamics::make_loose_bed(plan, loose_fraction);
  dynamics::StepWorkspace workspace;
  come_to_rest(world, settings, workspace);
  return world;
}

FrozenStep next_problem(const World& world, const dynamics::StepSettings& settings) {
  World midpoint = world;
  Grains& grains = midpoint.grains;
  for (Index i = 0; i < grains.free_count; ++i) {
    grains.x[i] += 0.5 * settings.h * grains.vx[i];
    grains.y[i] += 0.5 * settings.h * grains.vy[i];
    if (!world.boundary.periodic) continue;
    if (grains.x[i] < 0.0) grains.x[i] += world.boundary.length;
    if (grains.x[i] >= world.boundary.length) grains.x[i] -= world.boundary.length;
  }
  FrozenStep frozen;
  contact::NeighbourList list;
  contact::detect_contacts(list, grains, world.boundary, settings.margin, frozen.contacts);
  const bool moments = settings.law.rolling_friction != 0.0;
  frozen.contacts.moment.assign(moments ? frozen.contacts.a.size() : 0, 0.0);
  contact::recall_forces(world.contacts, frozen.contacts);
  dynamics::form_problem(midpoint, frozen.contacts, settings.law, settings.h, settings.solver.tolerance,
                         frozen.problem);
  for (std::size_t c = 0; c < frozen.contacts.moment.size(); ++c)
    frozen.guess.pr.push_back(frozen.contacts.moment[c] * settings.h /
                              solver::rolling_length(frozen.problem, static_cast<Index>(c)));
  for (double fn : frozen.contacts.fn) frozen.guess.pn.push_back(fn * settings.h);
  for (double ft : frozen.contacts.ft) frozen.guess.pt.push_back(ft * settings.h);
  return frozen;
}

Momentum momentum(const Grains& grains) {
  Momentum sum;
  for (Index i = 0; i < grains.free_count; ++i) {
    const double px = grains.mass[i] * grains.vx[i];
    const double py = grains.mass[i] * grains.vy[i];
    sum.x += px;
    sum.y += py;
    sum.angular += grains.x[i] * py - grains.y[i] * px + grains.inertia[i] * grains.omega[i];
  }
  return sum;
}

double smallest_gap(const World& world, Index grain) {
  const Grains& g = world.grains;
  const int images = world.boundary.periodic ? 1 : 0;
  double smallest = std::numeric_limits<double>::infinity();
  for (Index other = 0; other < g.count(); ++other)
    for (int image = -images; image <= images; ++image) {
      if (other == grain) continue;
      const double dx = g.x[other] + image * world.boundary.length - g.x[grain];
      const double distance = std::hypot(dx, g.y[other] - g.y[grain]);
      smallest = std::min(smallest, distance - g.radius[grain] - g.radius[other]);
    }
  for (const Plane& plane : world.boundary.planes)
    if (!plane.wall) smallest = std::min(smallest, g.y[grain] - plane.offset - g.radius[grain]);
  return smallest;
}

double smallest_gap(const World& world) {
  double smallest = std::numeric_limits<double>::infinity();
  for (Index i = 0; i < world.grains.free_count; ++i) smallest = std::min(smallest, smallest_gap(world, i));
  return smallest;
}

double mechanical_energy(const World& world) {
  const Vec2 g = gravity_vector(world);
  double energy = kinetic_energy(world.grains);
  for (Index i = 0; i < world.grains.free_count; ++i) {
    const double turns = world.grains.image[i] * world.boundary.length;
    energy -= world.grains.mass[i] * (g.x * (world.grains.x[i] + turns) + g.y * world.grains.y[i]);
  }
  return energy;
}

double weight(const World& world) {
  double mass = 0.0;
  for (Index i = 0; i < world.grains.free_count; ++i) mass += world.grains.mass[i];
  return mass * world.gravity;
}

}  // namespace talus::test
