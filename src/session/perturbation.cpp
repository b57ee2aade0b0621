#include "session/perturbation.h"

#include <algorithm>
#include <cmath>

#include "core/trigonometry.h"
#include "session/session.h"
#include "stress/free_surface.h"

namespace talus::session {
namespace {

/// Returns the mean height of the free surface within `half_width` of a position, m, continued periodically
/// in a periodic bed.
double mean_height(const World& world, double centre, double half_width) {
  const Boundary& boundary = world.boundary;
  const std::vector<stress::SurfaceArc> surface = stress::free_surface(world.grains, boundary);
  const double half = boundary.periodic ? std::min(half_width, 0.5 * boundary.length) : half_width;
  double area = 0.0, width = 0.0;
  for (const int image : {-1, 0, 1}) {
    if (image != 0 && !boundary.periodic) continue;
    const double from = std::max(0.0, centre - half + image * boundary.length);
    const double to = std::min(boundary.length, centre + half + image * boundary.length);
    if (!(to > from)) continue;
    area += stress::area_below(surface, from, to);
    width += to - from;
  }
  return width > 0.0 ? area / width : 0.0;
}

/// Returns the number of free grains whose centres have moved by more than `distance`.
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
  const auto in_patch = [&](double x) {
    return std::fabs(offset_along(world.boundary, centre, x)) < half_width;
  };
  const double lower_edge = mean_height(world, centre, half_width) - patch.depth * mean_diameter;
  std::vector<Index> found;
  for (Index i = 0; i < world.grains.free_count; ++i)
    if (in_patch(world.grains.x[i]) && world.grains.y[i] > lower_edge) found.push_back(i);
  return found;
}

double push(Grains& grains, std::span<const Index> pushed, double velocity) {
  const double before = kinetic_energy(grains);
  for (const Index i : pushed) grains.vx[i] += velocity;
  return kinetic_energy(grains) - before;
}

Trial follow(World& world, const scenario::Scenario& scenario, const std::function<void()>& should_continue) {
  const double diameter = scenario.grains.mean_diameter;
  const double time_unit = std::sqrt(diameter / world.gravity);
  const double h = scenario::time_step(scenario);
  const double rest_velocity = scenario.deposition.rest_velocity * world.gravity * h;
  const dynamics::FlowRule rule = dynamics::flow_rule(diameter, world.gravity, world.boundary);
  const Grains before = world.grains;
  dynamics::StepWorkspace workspace;
  dynamics::SurfaceFlow flow;
  Trial trial;
  int quiet = 0;
  double time = 0.0;
  while (trial.end == TrialEnd::undecided && time < trial_time * time_unit) {
    if (should_continue) should_continue();
    const dynamics::StepReport report = dynamics::step(world, step_settings(scenario, world), workspace);
    time += h;
    const double surface = stress::bed_volume(world.grains, world.boundary) / world.boundary.length;
    const double velocity =
        dynamics::surface_velocity(world.grains, surface - dynamics::surface_layer_depth * diameter);
    trial.displacement += h * velocity / diameter;
    dynamics::follow_surface(flow, velocity, world.tilt, h, rule);
    quiet = report.motion.rms_velocity <= rest_velocity ? quiet + 1 : 0;
    if (flow.failed)
      trial.end = TrialEnd::avalanche;
    else if (quiet >= dynamics::rest_steps && report.solver.converged)
      trial.end = TrialEnd::rest;
  }
  trial.time = time / time_unit;
  trial.moved = count_moved(world, before, diameter);
  return trial;
}

Trial push_trial(World world, const scenario::Scenario& scenario, const SurfacePatch& patch, double strength,
                 const std::function<void()>& should_continue) {
  const double diameter = scenario.grains.mean_diameter;
  const double disk_mass = scenario.grains.density * 0.25 * pi * diameter * diameter;
  const std::vector<Index> pushed = grains_in_patch(world, patch, 0.5 * world.boundary.length, diameter);
  const double energy = push(world.grains, pushed, strength * std::sqrt(world.gravity * diameter));
  Trial trial = follow(world, scenario, should_continue);
  trial.strength = strength;
  trial.energy = energy / (disk_mass * world.gravity * diameter);
  return trial;
}

}  // namespace talus::session
