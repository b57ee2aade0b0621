#include "frozen_step.h"

#include <cmath>

#include "session/session.h"

namespace talus::bench {
namespace {

void scale(std::vector<double>& values, double factor) {
  for (double& value : values) value *= factor;
}

double mean_mass(const solver::ContactProblem& problem) {
  double sum = 0.0;
  int count = 0;
  for (const double inverse : problem.inverse_mass)
    if (inverse > 0.0) {
      sum += 1.0 / inverse;
      ++count;
    }
  return sum / count;
}

}  // namespace

dynamics::StepSettings run_settings(double h, Candidates candidates) {
  dynamics::StepSettings settings = session::step_settings(scenario::Scenario{});
  settings.h = h;
  if (candidates == Candidates::close) settings.margin = 2e-4 * scenario::Scenario{}.grains.mean_diameter;
  return settings;
}

FrozenStep next_step(World world, double h, Candidates candidates) {
  dynamics::StepWorkspace workspace;
  dynamics::begin_step(world, run_settings(h, candidates), workspace);
  return {std::move(workspace.problem), std::move(workspace.solution), world.gravity * h};
}

double seconds_of(double dt) {
  return dt * std::sqrt(scenario::Scenario{}.grains.mean_diameter / World{}.gravity);
}

FrozenStep dimensionless_next_step(const World& world, double dt, Candidates candidates) {
  const double length = scenario::Scenario{}.grains.mean_diameter;
  const double time = seconds_of(1.0);
  FrozenStep step = next_step(world, dt * time, candidates);
  const double mass = mean_mass(step.problem);
  const double velocity = length / time;
  for (auto field : {&solver::ContactProblem::vx, &solver::ContactProblem::vy, &solver::ContactProblem::cn,
                     &solver::ContactProblem::ct})
    scale(step.problem.*field, 1.0 / velocity);
  scale(step.problem.omega, time);
  scale(step.problem.inverse_mass, mass);
  scale(step.problem.inverse_inertia, mass * length * length);
  scale(step.problem.lever, 1.0 / length);
  scale(step.guess.pn, 1.0 / (mass * velocity));
  scale(step.guess.pt, 1.0 / (mass * velocity));
  step.gravity_step = dt;
  return step;
}

solver::ContactSolution cold_guess(const solver::ContactProblem& problem) {
  solver::ContactSolution guess;
  guess.pn.assign(static_cast<std::size_t>(problem.contact_count()), 0.0);
  guess.pt = guess.pn;
  return guess;
}

}  // namespace talus::bench
