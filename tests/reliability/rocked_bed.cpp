#include "reliability/rocked_bed.h"

#include <algorithm>

#include "base/hash.h"
#include "core/trigonometry.h"
#include "dynamics/bed.h"
#include "stress/free_surface.h"
#include "stress/stress.h"

namespace talus::test {
namespace {

constexpr std::int64_t falling_steps = 400;
constexpr std::int64_t quarter_swing = 2000;  // steps from tilt 0 to the steepest one
constexpr double steepest = 35.0;             // deg, well above any angle of repose of these beds

/// Returns the tilt (deg) after `steps` steps: 0, then a triangular wave.
double tilt_after(std::int64_t steps) {
  const std::int64_t swung = std::max<std::int64_t>(0, steps - falling_steps);
  const std::int64_t phase = (swung + quarter_swing) % (4 * quarter_swing);  // 0 at -steepest
  const std::int64_t rise = std::min(phase, 4 * quarter_swing - phase) - quarter_swing;
  return steepest * static_cast<double>(rise) / static_cast<double>(quarter_swing);
}

RockedBed bed(const char* name, Index grains, Index columns, bool periodic, std::int64_t steps) {
  RockedBed bed;
  bed.name = name;
  bed.plan.grain_count = grains;
  bed.plan.length = columns * bed.plan.mean_diameter;
  bed.plan.periodic = periodic;
  bed.plan.seed = 5;
  bed.steps = steps;
  return bed;
}

dynamics::StepSettings settings_of(const RockedBed& bed, int threads) {
  dynamics::StepSettings settings;
  settings.h = 1e-3;
  settings.margin = 0.002 * bed.plan.mean_diameter;
  settings.law.restitution = bed.restitution;
  settings.law.allowed_overlap = 1e-4 * bed.plan.mean_diameter;
  settings.solver.kind = bed.solver;
  settings.solver.tolerance = 1e-5;
  settings.solver.max_iterations = 30;
  settings.solver.threads = threads;
  return settings;
}

bool same_pairs(const Contacts& x, const Contacts& y) {
  return x.a == y.a && x.b == y.b && x.shift == y.shift;
}

}  // namespace

std::vector<RockedBed> rocked_beds() {
  RockedBed walls = bed("walls", 30, 10, false, 100'000);
  walls.restitution = 0.3;
  RockedBed gauss_seidel = bed("gauss-seidel", 30, 10, true, 10'000);
  gauss_seidel.solver = solver::SolverKind::gauss_seidel;
  gauss_seidel.plan.rough_floor = false;
  return {bed("periodic", 30, 10, true, 100'000), walls, gauss_seidel, bed("large", 20000, 500, true, 300)};
}

RockedRun rock(const RockedBed& bed, std::int64_t steps, int threads,
               const std::function<void(const World&)>& watch, int alone_every) {
  dynamics::StepSettings settings = settings_of(bed, threads);
  World world = dynamics::make_loose_bed(bed.plan);
  dynamics::StepWorkspace workspace;
  RockedRun run;
  Contacts before;
  for (std::int64_t k = 0; k < steps; ++k) {
    world.tilt = radians(tilt_after(k));
    workspace.solver.accelerated.choice = {};  // all threads, whether or not they pay off
    settings.solver.threads = alone_every > 0 && k % alone_every == 0 ? 1 : threads;
    dynamics::step(world, settings, workspace);
    run.changes += !same_pairs(world.contacts, before);
    before = world.contacts;
    if (const auto& team = workspace.solver.accelerated.team) run.team = std::max(run.team, team->size());
    watch(world);
  }
  return run;
}

std::uint64_t hash_of(const World& world) {
  std::vector<Tensor2> moments;
  stress::internal_moments(world.grains, world.contacts, moments);
  Hasher hash;
  hash.add(state_hash(world));
  for (const Tensor2& moment : moments) hash.add(stress::stress_state(moment).ratio);
  for (const stress::SurfaceArc& arc : stress::free_surface(world.grains, world.boundary)) hash.add(arc.end);
  hash.add(stress::bed_volume(world.grains, world.boundary));
  hash.add(stress::surface_inclination(world.grains, world.boundary));
  return hash.value();
}

}  // namespace talus::test
