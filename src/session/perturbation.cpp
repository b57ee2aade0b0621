#include "session/perturbation.h"

#include <algorithm>
#include <cmath>

#include "core/trigonometry.h"
#include "session/session.h"
#include "stress/free_surface.h"

namespace talus {
namespace {

double mean_height(const std::vector<double>& heights) {
  double sum = 0.0;
  for (double height : heights) sum += height;
  return heights.empty() ? 0.0 : sum / static_cast<double>(heights.size());
}

std::vector<double> surface_of(const World& world, double mean_diameter) {
  return free_surface(world.grains, world.boundary, surface_sample_spacing * mean_diameter);
}

/// Free grains whose centres are more than `distance` from where they were.
Index count_moved(const World& world, const Grains& before, double distance) {
  const Grains& grains = world.grains;
  Index count = 0;
  for (Index i = 0; i < grains.free_count; ++i) {
    const double turns = grains.image[i] - before.image[i];
    const double dx = grains.x[i] - before.x[i] + turns * world.boundary.length;
    const double dy = grains.y[i] - before.y[i];
    if (dx * dx + dy * dy > distance * distance) ++count;
  }
  return count;
}

}  // namespace

std::string_view name_of(TrialEnd end) {
  switch (end) {
    case TrialEnd::rest:
      return "rest";
    case TrialEnd::avalanche:
      return "avalanche";
    case TrialEnd::undecided:
      break;
  }
  return "undecided";
}

std::vector<Index> grains_in_patch(const World& world, const SurfacePatch& patch, double centre,
                                   double mean_diameter) {
  const double half_width = 0.5 * patch.width * mean_diameter;
  const auto beside = [&](double x) {
    return std::fabs(offset_along(world.boundary, centre, x)) < half_width;
  };
  const std::vector<double> surface = surface_of(world, mean_diameter);
  const double spacing = world.boundary.length / static_cast<double>(surface.size());
  std::vector<double> above;
  for (std::size_t k = 0; k < surface.size(); ++k)
    if (beside((static_cast<double>(k) + 0.5) * spacing)) above.push_back(surface[k]);
  const double lower_edge = mean_height(above) - patch.depth * mean_diameter;
  std::vector<Index> found;
  for (Index i = 0; i < world.grains.free_count; ++i)
    if (beside(world.grains.x[i]) && world.grains.y[i] > lower_edge) found.push_back(i);
  return found;
}

double push(Grains& grains, std::span<const Index> pushed, double velocity) {
  const double before = kinetic_energy(grains);
  for (const Index i : pushed) grains.vx[i] += velocity;
  return kinetic_energy(grains) - before;
}

Trial follow(World& world, const Scenario& scenario, const std::function<void()>& keep_on) {
  const double diameter = scenario.grains.mean_diameter;
  const double time_unit = std::sqrt(diameter / world.gravity);
  const double h = time_step(scenario);
  const double rest_velocity = scenario.deposition.rest_velocity * world.gravity * h;
  const FlowRule rule = flow_rule(diameter, world.gravity, world.boundary);
  const Grains before = world.grains;
  StepWorkspace workspace;
  SurfaceFlow flow;
  Trial trial;
  int quiet = 0;
  double time = 0.0;
  while (trial.end == TrialEnd::undecided && time < trial_time * time_unit) {
    if (keep_on) keep_on();
    const StepReport report = step(world, step_settings(scenario, world), workspace);
    time += h;
    const double surface = mean_height(surface_of(world, diameter));
    const double velocity = surface_velocity(world.grains, surface - surface_layer_depth * diameter);
    trial.displacement += h * velocity / diameter;
    follow_surface(flow, velocity, world.tilt, h, rule);
    quiet = report.motion.rms_velocity <= rest_velocity ? quiet + 1 : 0;
    if (flow.failed)
      trial.end = TrialEnd::avalanche;
    else if (quiet >= rest_steps && report.solver.converged)
      trial.end = TrialEnd::rest;
  }
  trial.time = time / time_unit;
  trial.moved = count_moved(world, before, diameter);
  return trial;
}

Trial push_trial(World world, const Scenario& scenario, const SurfacePatch& patch, double strength,
                 const std::function<void()>& keep_on) {
  const double diameter = scenario.grains.mean_diameter;
  const double disk_mass = scenario.grains.density * 0.25 * pi * diameter * diameter;
  const std::vector<Index> pushed = grains_in_patch(world, patch, 0.5 * world.boundary.length, diameter);
  const double energy = push(world.grains, pushed, strength * std::sqrt(world.gravity * diameter));
  Trial trial = follow(world, scenario, keep_on);
  trial.strength = strength;
  trial.energy = energy / (disk_mass * world.gravity * diameter);
  return trial;
}

}  // namespace talus
