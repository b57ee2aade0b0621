#include "problems/step_problem.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <optional>
#include <utility>

#include "base/errors.h"
#include "core/trigonometry.h"
#include "dynamics/step.h"
#include "session/command.h"
#include "session/frame_state.h"
#include "session/run_header.h"
#include "session/session.h"

namespace talus::problems {
namespace {

/// Returns the gap below which two bodies of a frame may touch: the error of a distance in the box due to
/// rounding to single precision.
double gap_resolution(const World& world) {
  double farthest = world.boundary.length;
  for (const double y : world.grains.y) farthest = std::max(farthest, std::fabs(y));
  return farthest * 0x1p-23;
}

void close_remembered_contacts(double resolution, Contacts& contacts) {
  for (Index c = 0; c < contacts.count(); ++c)
    if (contacts.fn[c] > 0.0 && std::fabs(contacts.gap[c]) <= resolution) contacts.gap[c] = 0.0;
}

double weight(const World& world) {
  double mass = 0.0;
  for (Index i = 0; i < world.grains.free_count; ++i) mass += world.grains.mass[i];
  return mass * world.gravity;
}

/// Returns the tilt of the step after a frame. With a programme it follows from the number of the step;
/// otherwise, unless a command has changed the rate, it is an integer multiple of the step of the tilt, as in
/// a run. The first frame is the one before the first step of the tilt.
double next_tilt(const io::RunFile& run, const World& world, const scenario::Scenario& scenario,
                 const session::Schedule& now) {
  const double tilt = world.tilt;
  if (now.course) return tilt + now.course->rate * scenario::time_step(scenario);
  if (run.has_program())
    return scenario::TiltProgram(scenario).tilt(world.step - session::steps_before_tilt(run) + 1);
  const double step_angle = radians(scenario.tilt.step);
  return static_cast<double>(std::llround(tilt / step_angle) + 1) * step_angle;
}

/// Forms the problem of the next step of a world and moves its grains to the midpoint. `contacts` receives
/// its contacts with the remembered forces.
StepProblem form_step(World& world, const dynamics::StepSettings& settings, double closed_below,
                      double mean_diameter, Contacts& contacts) {
  if (settings.law.rolling_friction > 0.0)
    throw Error(
        ExitCode::bad_data,
        "the contacts of the run resist rolling (contact.rolling_friction = {:g}), but contact problems in "
        "files and admissible forces do not include moments; choose a run with contact.rolling_friction = 0",
        settings.law.rolling_friction);
  dynamics::StepWorkspace workspace;
  dynamics::begin_step(world, settings, workspace);
  if (closed_below > 0.0) {
    close_remembered_contacts(closed_below, workspace.contacts);
    dynamics::form_problem(world, workspace.contacts, settings.law, settings.h, settings.solver.tolerance,
                           workspace.problem);
  }
  StepProblem step;
  step.problem = std::move(workspace.problem);
  step.guess = std::move(workspace.solution);
  solver::velocities_from_impulses(step.problem, step.guess);
  step.scales = {settings.h, world.gravity, world.tilt, mean_diameter, weight(world)};
  contacts = std::move(workspace.contacts);
  return step;
}

/// Returns the tolerance that the run requires of the next step of a world.
StepTolerance tolerance_of(const World& world, const scenario::Scenario& scenario) {
  const dynamics::StepSettings settings = session::step_settings(scenario, world);
  return {rms_velocity(world.grains) / (world.gravity * settings.h), settings.solver.tolerance,
          scenario.solver.tolerance};
}

/// A frame as the start of a step.
struct FrameStart {
  World world;
  dynamics::StepSettings settings;
  StepTolerance tolerance;
  double mean_diameter = 0.0;  ///< m
  double closed_below = 0.0;   ///< m, gap below which contacts are closed; 0 if positions are not rounded
  double next_tilt = 0.0;      ///< rad
};
FrameStart start_at_frame(const io::RunFile& run, std::size_t k) {
  const scenario::Scenario scenario = runs::stored_scenario(run.header(), "/parameters/scenario_resolved");
  FrameStart start;
  start.world = session::world_at_frame(run, k);
  const session::Schedule now = session::commanded_schedule(run, start.world.step + 1);
  start.settings = session::step_settings(scenario);
  start.tolerance = tolerance_of(start.world, scenario);
  start.settings.law.friction = now.friction.value_or(scenario.contact.friction);
  start.mean_diameter = scenario.grains.mean_diameter;
  if (start.world.step != run.checkpoint().world.step) start.closed_below = gap_resolution(start.world);
  start.next_tilt = next_tilt(run, start.world, scenario, now);
  if (now.drag) session::pull(*now.drag, start.mean_diameter, scenario::time_step(scenario), start.world);
  return start;
}

}  // namespace

StepProblem problem_after_frame(const io::RunFile& run, std::size_t k) {
  FrameStart start = start_at_frame(run, k);
  start.world.tilt = start.next_tilt;
  Contacts contacts;
  StepProblem step =
      form_step(start.world, start.settings, start.closed_below, start.mean_diameter, contacts);
  step.tolerance = start.tolerance;
  return step;
}

FrozenBed freeze(World world, const dynamics::StepSettings& settings, double mean_diameter) {
  const double closed_at_rest = 0.01 * world.gravity * settings.h * settings.h;
  const double closed_below = std::max(gap_resolution(world), closed_at_rest);
  for (auto* velocity : {&world.grains.vx, &world.grains.vy, &world.grains.omega})
    std::ranges::fill(*velocity, 0.0);
  FrozenBed bed;
  bed.law = settings.law;
  bed.step = form_step(world, settings, closed_below, mean_diameter, bed.world.contacts);
  std::swap(world.contacts, bed.world.contacts);
  bed.world = std::move(world);
  return bed;
}

FrozenBed frozen_frame(const io::RunFile& run, std::size_t k) {
  FrameStart start = start_at_frame(run, k);
  // Other forces of the frame are those that its own friction allows, not that of the next step.
  start.settings.law.friction = run.friction_of_frame(k).grains;
  start.settings.law.wall_friction = run.friction_of_frame(k).walls;
  return freeze(std::move(start.world), start.settings, start.mean_diameter);
}

double carried_weight(const StepProblem& step, const solver::ContactSolution& solution) {
  const solver::ContactProblem& problem = step.problem;
  const double up_x = -sine(step.scales.tilt);
  const double up_y = cosine(step.scales.tilt);
  double impulse = 0.0;
  for (Index c = 0; c < problem.contact_count(); ++c) {
    const bool a_moves = problem.inverse_mass[problem.a[c]] > 0.0;
    const bool b_moves = problem.inverse_mass[problem.b[c]] > 0.0;
    if (a_moves == b_moves) continue;
    const double px = solution.pn[c] * problem.nx[c] - solution.pt[c] * problem.ny[c];
    const double py = solution.pn[c] * problem.ny[c] + solution.pt[c] * problem.nx[c];
    impulse += (b_moves ? 1.0 : -1.0) * (px * up_x + py * up_y);
  }
  return impulse / (step.scales.weight * step.scales.h);
}

}  // namespace talus::problems
