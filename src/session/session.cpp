#include "session/session.h"

#include <algorithm>
#include <cmath>

#include "core/errors.h"
#include "core/trigonometry.h"
#include "stress/free_surface.h"

namespace talus {
namespace {

std::int64_t steps_between(double degrees_between, double step) {
  return std::max<std::int64_t>(1, std::llround(degrees_between / step));
}

double seconds(const StepReport& report) {
  double sum = 0.0;
  for (double stage : report.seconds) sum += stage;
  return sum;
}

}  // namespace

ContactLawParameters contact_law(const Scenario& scenario) {
  ContactLawParameters law;
  law.friction = scenario.contact.friction;
  law.wall_friction = scenario.contact.wall_friction;
  law.restitution = scenario.contact.restitution;
  law.tangential_restitution = scenario.contact.tangential_restitution;
  law.allowed_overlap = scenario.solver.allowed_overlap * scenario.grains.mean_diameter;
  law.overlap_correction = scenario.solver.overlap_correction;
  return law;
}

StepSettings step_settings(const Scenario& scenario) {
  // Beside what the velocities may close, which the step adds: room for what they become in the step.
  constexpr double margin_over_d = 0.002;
  StepSettings settings;
  settings.h = time_step(scenario);
  settings.margin = margin_over_d * scenario.grains.mean_diameter;
  settings.law = contact_law(scenario);
  settings.solver.kind = scenario.solver.method == SolverMethod::accelerated ? SolverKind::accelerated
                                                                             : SolverKind::gauss_seidel;
  settings.solver.tolerance = scenario.solver.tolerance;
  settings.solver.max_iterations = scenario.solver.max_iterations;
  return settings;
}

StepSettings step_settings(const Scenario& scenario, const World& world) {
  StepSettings settings = step_settings(scenario);
  const double velocity = rms_velocity(world.grains) / (world.gravity * settings.h);
  settings.solver.tolerance = std::clamp(velocity * scenario.solver.moving_tolerance,
                                         scenario.solver.tolerance, scenario.solver.moving_tolerance);
  return settings;
}

RunStatics run_statics(const Scenario& scenario, const World& world) {
  RunStatics statics;
  const Grains grains = with_all_arrivals(world.grains, arrivals_of(scenario), scenario.grains.density);
  statics.free_count = grains.free_count;
  statics.radius = grains.radius;
  statics.mass = grains.mass;
  statics.periodic = world.boundary.periodic;
  statics.length = world.boundary.length;
  statics.depth = scenario.bed.depth * scenario.grains.mean_diameter;
  statics.mean_diameter = scenario.grains.mean_diameter;
  statics.gravity = world.gravity;
  statics.friction = scenario.contact.friction;
  return statics;
}

Session::Session(const Scenario& scenario)
    : scenario_(scenario), world_(initial_bed(scenario)), arrivals_(arrivals_of(scenario)) {
  let_arrive(arrivals_, pour_rule(scenario_), time_step(scenario_), world_);
}

ContactLawParameters Session::law() const {
  ContactLawParameters law = contact_law(scenario_);
  if (phase_ == Phase::deposition) {
    law.friction = scenario_.deposition.friction.value_or(law.friction);
    law.wall_friction = scenario_.deposition.wall_friction.value_or(law.wall_friction);
  }
  law.friction = friction_.value_or(law.friction);
  return law;
}

StepSettings Session::settings() const {
  StepSettings settings = step_settings(scenario_, world_);
  settings.law = law();
  settings.solver.threads = threads_;
  return settings;
}

bool Session::is_quiet() const {
  return rms_velocity(world_.grains) <=
         scenario_.deposition.rest_velocity * world_.gravity * time_step(scenario_);
}

void Session::apply(Command command) {
  if (phase_ == Phase::done)
    throw Error(ExitCode::usage, std::string(name_of(command.kind)) + ": the run has ended");
  check_command(command, scenario_, world_);
  switch (command.kind) {
    case CommandKind::push:
      world_.grains.vx[command.grain] += command.x;
      world_.grains.vy[command.grain] += command.y;
      break;
    case CommandKind::drop:
      drop_grains(world_, command.grain, command.x, command.y, scenario_.grains.mean_diameter);
      break;
    case CommandKind::friction:
      friction_ = command.x;
      break;
    case CommandKind::tilt_rate:
      if (phase_ == Phase::flow)
        throw Error(ExitCode::usage, "tilt_rate: the slope has failed; its tilt goes by tilt.after_failure");
      course_ = TiltCourse{command.x, scheduled_tilt(), tilt_steps_};
  }
  command.step = world_.step;
  segment_.commands.push_back(command);
}

const StepReport& Session::advance() {
  if (!broken_guard_.empty() && phase_ != Phase::done) throw Error(ExitCode::internal, broken_guard_);
  if (phase_ == Phase::deposition)
    advance_deposition();
  else if (phase_ == Phase::tilt)
    advance_tilt();
  else if (phase_ == Phase::flow)
    advance_flow();
  return report_;
}

bool Session::have_all_arrived() const {
  return static_cast<std::size_t>(world_.grains.free_count) >= arrivals_.size();
}

void Session::advance_deposition() {
  take_step();
  if (!have_all_arrived()) {
    let_arrive(arrivals_, pour_rule(scenario_), time_step(scenario_), world_);
    return;
  }
  if (is_at_rest() && report_.solver.converged)
    begin_tilt();
  else if (world_.time >= end_of_arrivals(scenario_) + scenario_.deposition.max_time)
    throw Error(ExitCode::bad_data,
                "the bed did not come to rest within deposition.max_time = " +
                    std::to_string(scenario_.deposition.max_time) + " s: its rms velocity is " +
                    std::to_string(report_.rms_velocity / (world_.gravity * time_step(scenario_))) +
                    " g h, rest asks for deposition.rest_velocity = " +
                    std::to_string(scenario_.deposition.rest_velocity) +
                    " g h; allow more time, or set solver.moving_tolerance or solver.tolerance lower");
}

void Session::begin_tilt() {
  phase_ = Phase::tilt;
  baseline_ = measure_baseline(world_, scenario_.grains.mean_diameter);
  record_row();
  segment_.frames.push_back(make_frame(world_, law()));
}

double Session::scheduled_tilt() const {
  if (!course_) return static_cast<double>(tilt_steps_) * radians(scenario_.tilt.step);
  return course_->from +
         static_cast<double>(tilt_steps_ - course_->since) * radians(course_->rate) * time_step(scenario_);
}

void Session::advance_tilt() {
  ++tilt_steps_;
  world_.tilt = scheduled_tilt();
  const double velocity = take_step_and_follow();
  const bool failed_before = flow_.failed;
  follow_surface(flow_, velocity, world_.tilt, time_step(scenario_),
                 flow_rule(scenario_.grains.mean_diameter, world_.gravity, world_.boundary));

  const double tilt = degrees(world_.tilt);
  const bool followed = flow_.failed && scenario_.tilt.after_failure != AfterFailure::stop;
  const bool reached = scenario_.tilt.end_angle
                           ? tilt >= *scenario_.tilt.end_angle - 0.5 * scenario_.tilt.step
                           : flow_.failed || tilt >= steepest_tilt;
  const bool ends = followed || reached;
  record(ends, ends || flow_.failed != failed_before);
  if (ends) phase_ = followed ? Phase::flow : Phase::done;
}

void Session::advance_flow() {
  ++flow_steps_;
  const double time = static_cast<double>(flow_steps_) * time_step(scenario_);
  const bool lowered = scenario_.tilt.after_failure == AfterFailure::lower;
  if (lowered) world_.tilt = std::max(0.0, scheduled_tilt() - time * radians(scenario_.tilt.lowering_rate));
  take_step_and_follow();

  const bool rests = is_at_rest() && report_.solver.converged;
  const bool ends = rests || (lowered ? world_.tilt == 0.0 : time >= scenario_.deposition.max_time);
  record(ends, ends);
  if (rests)
    angle_at_rest_ =
        world_.tilt - surface_inclination(world_.grains, world_.boundary,
                                          surface_sample_spacing * scenario_.grains.mean_diameter);
  if (ends) phase_ = Phase::done;
}

double Session::take_step_and_follow() {
  take_step();
  const double layer = surface_layer_depth * scenario_.grains.mean_diameter;
  const double velocity = surface_velocity(world_.grains, surface_height_ - layer);
  surface_displacement_ += time_step(scenario_) * velocity;
  return velocity;
}

void Session::record(bool row, bool frame) {
  const auto due = [this](double every) {
    return (tilt_steps_ + flow_steps_) % steps_between(every, scenario_.tilt.step) == 0;
  };
  if (row || due(scenario_.output.observable_every)) record_row();
  if (frame || due(scenario_.output.frame_every)) segment_.frames.push_back(make_frame(world_, law()));
}

void Session::take_step() {
  report_ = step(world_, settings(), workspace_);
  quiet_steps_ = is_quiet() && have_all_arrived() ? quiet_steps_ + 1 : 0;
  const bool tilting = phase_ == Phase::tilt;
  if (!report_.solver.converged)
    ++(tilting                       ? record_.unconverged_tilt
       : phase_ == Phase::deposition ? record_.unconverged_deposition
                                     : record_.unconverged_flow);
  const double eta = report_.solver.residual.eta;
  residual_since_row_ = std::max(residual_since_row_, eta);
  if (tilting) {
    double& worst = is_at_rest() ? record_.residual_max_rest : record_.residual_max_moving;
    worst = std::max(worst, eta);
  }
  for (std::size_t k = 0; k < stage_count; ++k) stage_seconds_[k] += report_.seconds[k];
  (phase_ == Phase::deposition ? deposition_seconds_ : tilt_seconds_) += seconds(report_);
  segment_.steps.push_back(step_row(world_, report_, static_cast<double>(phase_)));
  watch();
}

void Session::watch() {
  unconverged_in_a_row_ = report_.solver.converged ? 0 : unconverged_in_a_row_ + 1;
  const GuardValues values = guard_values(world_, report_, unconverged_in_a_row_, scenario_);
  const GuardValues limits = guard_limits(scenario_);
  for (std::size_t k = 0; k < guard_count; ++k) {
    if (values[k] <= limits[k]) continue;
    if (scenario_.guards.action == GuardAction::warn) {
      if (guard_warnings_.steps[k]++ == 0) guard_warnings_.first[k] = world_.step;
    } else if (broken_guard_.empty()) {
      broken_guard_ = guard_message(static_cast<Guard>(k), values[k], limits[k], world_.step);
    }
  }
}

void Session::record_row() {
  RowContext context;
  context.baseline = baseline_;
  context.law = law();
  context.mean_diameter = scenario_.grains.mean_diameter;
  context.surface_displacement = surface_displacement_;
  context.largest_overlap = report_.largest_overlap;
  context.residual = residual_since_row_;
  context.at_rest = is_at_rest();
  segment_.observables.push_back(measure(world_, context));
  residual_since_row_ = 0.0;
  const double volume = (1.0 + at(segment_.observables.back(), Observable::volume_strain)) * baseline_.volume;
  surface_height_ = volume / world_.boundary.length;
}

std::optional<double> Session::angle_of_repose() const {
  return flow_.failed ? std::optional<double>(flow_.onset_tilt) : std::nullopt;
}

}  // namespace talus
