#include "session/session.h"

#include <algorithm>
#include <cmath>

#include "base/errors.h"
#include "core/trigonometry.h"
#include "scenario/scripted_command.h"
#include "stress/free_surface.h"

namespace talus::session {
namespace {

double seconds(const dynamics::StepReport& report) {
  double sum = 0.0;
  for (double stage : report.seconds) sum += stage;
  return sum;
}

}  // namespace

dynamics::ContactLawParameters contact_law(const Scenario& scenario) {
  return {.friction = scenario.contact.friction,
          .wall_friction = scenario.contact.wall_friction,
          .rolling_friction = scenario.contact.rolling_friction,
          .restitution = scenario.contact.restitution,
          .tangential_restitution = scenario.contact.tangential_restitution,
          .allowed_overlap = scenario.solver.allowed_overlap * scenario.grains.mean_diameter,
          .overlap_correction = scenario.solver.overlap_correction};
}

dynamics::StepSettings step_settings(const Scenario& scenario) {
  // Margin in addition to the distance that velocities may close, which the step adds: room for their change
  // in the step.
  constexpr double margin_over_d = 0.002;
  dynamics::StepSettings settings;
  settings.h = scenario::time_step(scenario);
  settings.margin = margin_over_d * scenario.grains.mean_diameter;
  settings.law = contact_law(scenario);
  settings.solver.kind = scenario.solver.method == scenario::SolverMethod::accelerated
                             ? solver::SolverKind::accelerated
                             : solver::SolverKind::gauss_seidel;
  settings.solver.tolerance = scenario.solver.tolerance;
  settings.solver.max_iterations = scenario.solver.max_iterations;
  return settings;
}

dynamics::StepSettings step_settings(const Scenario& scenario, const World& world) {
  dynamics::StepSettings settings = step_settings(scenario);
  const double velocity = rms_velocity(world.grains) / (world.gravity * settings.h);
  settings.solver.tolerance = std::clamp(velocity * scenario.solver.moving_tolerance,
                                         scenario.solver.tolerance, scenario.solver.moving_tolerance);
  return settings;
}

RunStatics run_statics(const Scenario& scenario, const World& world) {
  const Grains grains =
      dynamics::with_remaining_grains(world.grains, arrivals_of(scenario), scenario.grains.density);
  return {.free_count = grains.free_count,
          .radius = grains.radius,
          .mass = grains.mass,
          .periodic = world.boundary.periodic,
          .length = world.boundary.length,
          .depth = scenario.bed.depth * scenario.grains.mean_diameter,
          .mean_diameter = scenario.grains.mean_diameter,
          .gravity = world.gravity};
}

double scheduled_tilt(const Scenario& scenario, const scenario::TiltProgram& program,
                      const Schedule& schedule) {
  if (!program.empty() && !schedule.course) return program.tilt(schedule.tilt_steps);
  if (!schedule.course) return static_cast<double>(schedule.tilt_steps) * radians(scenario.tilt.step);
  return schedule.course->from + static_cast<double>(schedule.tilt_steps - schedule.course->since) *
                                     schedule.course->rate * scenario::time_step(scenario);
}

Session::Session(const Scenario& scenario)
    : scenario_(scenario),
      program_(scenario),
      world_(initial_bed(scenario, &bed_remark_)),
      arrivals_(arrivals_of(scenario)) {
  const auto grains = std::max(world_.grains.free_count, static_cast<Index>(arrivals_.size()));
  for (std::size_t k = 0; k < scenario_.commands.size(); ++k)
    if (const std::string fault =
            scenario::command_fault(scenario::command_of(scenario_.commands[k]), scenario_, grains);
        !fault.empty())
      throw Error(ExitCode::bad_data, "{}: {}", scenario::command_section(k), fault);
  reserve_grains();
  dynamics::add_due_grains(arrivals_, pour_rule(scenario_), scenario::time_step(scenario_), world_);
}

Session::Session(const Scenario& scenario, io::Checkpoint checkpoint, const std::string& origin,
                 const std::string& group)
    : scenario_(scenario),
      program_(scenario),
      world_(std::move(checkpoint.world)),
      schedule_(stored_schedule(checkpoint, follows_failure(scenario), origin, group)),
      arrivals_(arrivals_of(scenario)) {
  reserve_grains();
}

void Session::reserve_grains() {
  const auto waiting = std::max<std::ptrdiff_t>(0, std::ssize(arrivals_) - world_.grains.free_count);
  reserve(world_.grains, static_cast<std::size_t>(world_.grains.count() + waiting));
}

dynamics::ContactLawParameters Session::law() const {
  dynamics::ContactLawParameters law = contact_law(scenario_);
  if (schedule_.phase == Phase::deposition) {
    law.friction = deposition_friction(scenario_).grains;
    law.wall_friction = deposition_friction(scenario_).walls;
  }
  law.friction = schedule_.friction.value_or(law.friction);
  return law;
}

dynamics::ContactLawParameters Session::law_of_last_step() const {
  dynamics::ContactLawParameters last = law();
  last.friction = schedule_.last.friction.value_or(last.friction);
  last.wall_friction = schedule_.last.wall_friction.value_or(last.wall_friction);
  return last;
}

Frame Session::frame() const { return make_frame(world_, law_of_last_step()); }

bool Session::adopt_friction() {
  if (!schedule_.friction) return false;
  const Scenario was = scenario_;
  scenario_.contact.friction = *std::exchange(schedule_.friction, {});
  keep_deposition_friction(was, scenario_);
  if (schedule_.deposition_friction) scenario_.deposition.friction = schedule_.deposition_friction;
  return true;
}

dynamics::StepSettings Session::settings() const {
  dynamics::StepSettings settings = step_settings(scenario_, world_);
  settings.law = law();
  settings.solver.threads = threads_;
  return settings;
}

bool Session::is_quiet() const {
  return report_.motion.rms_velocity <=
         scenario_.deposition.rest_velocity * world_.gravity * scenario::time_step(scenario_);
}

void Session::apply(Command command) {
  if (schedule_.phase == Phase::done)
    throw Error(ExitCode::usage, "{}: the run has ended", name_of(command.kind));
  check_command(command, scenario_, world_);
  switch (command.kind) {
    case CommandKind::push:
      world_.grains.vx[command.grain] += command.x;
      world_.grains.vy[command.grain] += command.y;
      break;
    case CommandKind::drop:
      drop_grains(world_, command.grain, command.x, command.y);
      break;
    case CommandKind::friction:
      schedule_.friction = command.x;
      break;
    case CommandKind::tilt_rate:
      if (schedule_.phase == Phase::flow)
        throw Error(ExitCode::usage,
                    "tilt_rate: the slope has failed, so its tilt follows tilt.after_failure");
      schedule_.course = TiltCourse{radians(command.x) + 0.0, scheduled_tilt(scenario_, program_, schedule_),
                                    schedule_.tilt_steps};
      break;
    case CommandKind::drag:
      schedule_.drag = Drag{command.grain, command.x, command.y};
      break;
    case CommandKind::release:
      if (!schedule_.drag) throw Error(ExitCode::usage, "release: no grain is being dragged");
      schedule_.drag.reset();
  }
  command.step = world_.step;
  segment_.commands.push_back(command);
}

void Session::record_start() {
  record_row();
  segment_.frames.push_back(frame());
}

void Session::check_guards() const {
  for (std::size_t k = 0; k < guard_count; ++k)
    if (const double value = schedule_.broken[k]; value != 0.0 && schedule_.phase != Phase::done)
      throw Error(ExitCode::bad_data, guard_message(k, value, guard_limits(scenario_)[k], world_.step));
}

void Session::follow_commands() {
  if (scenario_.commands.empty() || (schedule_.phase != Phase::tilt && schedule_.phase != Phase::flow))
    return;
  const std::vector<std::size_t> waiting = waiting_commands(scenario_, schedule_);
  ScriptCourse now = schedule_.script.value_or(ScriptCourse());
  now.highest = std::max(now.highest, world_.tilt);
  now.lowest = std::min(now.lowest, world_.tilt);
  now.steps = schedule_.tilt_steps + schedule_.flow_steps;
  std::optional<std::pair<World, Schedule>> before;
  const std::size_t recorded = segment_.commands.size();
  for (const std::size_t k : waiting) {
    const scenario::ScriptedCommand& command = scenario_.commands[k];
    if (!follows_script_ || !is_reached(command, scenario_, now)) continue;
    if (!before) before.emplace(world_, schedule_);
    try {
      apply(scenario::command_of(command));
    } catch (const Error& error) {
      // No command that is due counts as carried out, so that a resumed run finds them all.
      world_ = before->first;
      schedule_ = before->second;
      segment_.commands.resize(recorded);
      throw Error(ExitCode::bad_data, "{}, {}: {}", scenario::command_section(k),
                  scenario::moment_text(command), error.what());
    }
  }
  schedule_.script = now;
}

const dynamics::StepReport& Session::advance() {
  check_guards();
  follow_commands();
  const StepSnapshot before = snapshot();
  try {
    if (schedule_.phase == Phase::deposition)
      advance_deposition();
    else if (schedule_.phase == Phase::tilt)
      advance_tilt();
    else if (schedule_.phase == Phase::flow)
      advance_flow();
  } catch (...) {
    if (world_.step == before.step) restore(before);  // the step could not be taken
    throw;
  }
  return report_;
}

Session::StepSnapshot Session::snapshot() const {
  StepSnapshot before{world_.step, world_.tilt, schedule_.tilt_steps, schedule_.flow_steps, {}};
  if (schedule_.drag) {
    const Index grain = schedule_.drag->grain;
    before.dragged = {world_.grains.vx[grain], world_.grains.vy[grain]};
  }
  return before;
}

void Session::restore(const StepSnapshot& before) {
  world_.tilt = before.tilt;
  schedule_.tilt_steps = before.tilt_steps;
  schedule_.flow_steps = before.flow_steps;
  if (!schedule_.drag) return;
  world_.grains.vx[schedule_.drag->grain] = before.dragged.x;
  world_.grains.vy[schedule_.drag->grain] = before.dragged.y;
}

bool Session::have_all_arrived() const {
  return static_cast<std::size_t>(world_.grains.free_count) >= arrivals_.size();
}

void Session::advance_deposition() {
  take_step();
  if (!have_all_arrived()) {
    dynamics::add_due_grains(arrivals_, pour_rule(scenario_), scenario::time_step(scenario_), world_);
    return;
  }
  if (is_at_rest() && report_.solver.converged) {
    begin_tilt();
  } else if (world_.time >= end_of_arrivals(scenario_) + scenario_.deposition.max_time) {
    const double velocity = report_.motion.rms_velocity / (world_.gravity * scenario::time_step(scenario_));
    throw Error(ExitCode::bad_data,
                "the bed did not come to rest within deposition.max_time = {:g} s: its rms "
                "velocity is {:.3g} g h, rest requires deposition.rest_velocity = {:g} g h; {}",
                scenario_.deposition.max_time, velocity, scenario_.deposition.rest_velocity,
                advice_for_rest(scenario_, velocity));
  }
}

void Session::begin_tilt() {
  schedule_.phase = Phase::tilt;
  schedule_.deposition_friction = schedule_.friction;
  schedule_.baseline = measure_baseline(world_);
  if (!program_.empty()) schedule_.last_tilt_step = world_.step;
  record_start();
}

bool Session::tilt_is_over() const {
  if (follows_program()) return schedule_.flow.failed || schedule_.tilt_steps >= program_.steps();
  const double tilt = std::abs(degrees(world_.tilt));
  return scenario_.tilt.end_angle ? tilt >= *scenario_.tilt.end_angle - 0.5 * scenario_.tilt.step
                                  : schedule_.flow.failed || tilt >= steepest_tilt;
}

void Session::advance_tilt() {
  ++schedule_.tilt_steps;
  world_.tilt = scheduled_tilt(scenario_, program_, schedule_);
  const double velocity = take_step_and_follow();
  if (schedule_.last_tilt_step) schedule_.last_tilt_step = world_.step;
  const bool failed_before = schedule_.flow.failed;
  const double downslope = world_.tilt < 0.0 ? -velocity : velocity;
  dynamics::follow_surface(
      schedule_.flow, downslope, std::abs(world_.tilt), scenario::time_step(scenario_),
      dynamics::flow_rule(scenario_.grains.mean_diameter, world_.gravity, world_.boundary));

  const bool followed = schedule_.flow.failed && follows_failure(scenario_);
  const bool ends = followed || tilt_is_over();
  // Each part of a programme between two turning points is a separate loop.
  const bool turns = follows_program() && program_.turns_at(schedule_.tilt_steps);
  record(ends || turns, ends || turns || schedule_.flow.failed != failed_before);
  if (ends) schedule_.phase = followed ? Phase::flow : Phase::done;
}

void Session::advance_flow() {
  ++schedule_.flow_steps;
  const double time = static_cast<double>(schedule_.flow_steps) * scenario::time_step(scenario_);
  const bool lowered = scenario_.tilt.after_failure == scenario::AfterFailure::lower;
  const double failed_at = scheduled_tilt(scenario_, program_, schedule_),
               side = failed_at < 0.0 ? -1.0 : 1.0;
  if (lowered)
    world_.tilt = side * std::max(0.0, side * failed_at - time * radians(scenario_.tilt.lowering_rate)) + 0.0;
  take_step_and_follow();

  const bool rests = is_at_rest() && report_.solver.converged;
  const bool ends = rests || (lowered ? world_.tilt == 0.0 : time >= scenario_.deposition.max_time);
  record(ends, ends);
  if (rests)
    schedule_.angle_at_rest =
        side * (world_.tilt - stress::surface_inclination(world_.grains, world_.boundary));
  if (ends) schedule_.phase = Phase::done;
}

double Session::take_step_and_follow() {
  take_step();
  const double layer = dynamics::surface_layer_depth * scenario_.grains.mean_diameter;
  const double velocity = dynamics::surface_velocity(world_.grains, schedule_.surface_height - layer);
  schedule_.surface_displacement += scenario::time_step(scenario_) * velocity;
  return velocity;
}

void Session::record(bool row, bool frame) {
  const auto due = [this](double every) {
    const std::int64_t steps = std::max<std::int64_t>(1, std::llround(every / scenario_.tilt.step));
    return (schedule_.tilt_steps + schedule_.flow_steps) % steps == 0;
  };
  if (row || due(scenario_.output.observable_every)) record_row();
  if (frame || due(scenario_.output.frame_every)) segment_.frames.push_back(this->frame());
}

void Session::take_step() {
  if (schedule_.drag)
    pull(*schedule_.drag, scenario_.grains.mean_diameter, scenario::time_step(scenario_), world_);
  report_ = dynamics::step(world_, settings(), workspace_);
  schedule_.quiet_steps = is_quiet() && have_all_arrived() ? schedule_.quiet_steps + 1 : 0;
  const bool tilting = schedule_.phase == Phase::tilt;
  if (!report_.solver.converged)
    ++(tilting                                ? schedule_.record.unconverged_tilt
       : schedule_.phase == Phase::deposition ? schedule_.record.unconverged_deposition
                                              : schedule_.record.unconverged_flow);
  const double eta = report_.solver.residual.eta;
  const dynamics::ContactLawParameters used = law();
  schedule_.last = {report_.largest_overlap, eta, report_.solver.converged ? 1.0 : 0.0, used.friction,
                    used.wall_friction};
  schedule_.residual_since_row = std::max(schedule_.residual_since_row, eta);
  if (tilting) {
    double& worst = is_at_rest() ? schedule_.record.residual_max_rest : schedule_.record.residual_max_moving;
    worst = std::max(worst, eta);
  }
  for (std::size_t k = 0; k < dynamics::stage_count; ++k) schedule_.seconds.stages[k] += report_.seconds[k];
  (schedule_.phase == Phase::deposition ? schedule_.seconds.deposition : schedule_.seconds.tilt) +=
      seconds(report_);
  segment_.steps.push_back(step_row(world_, report_, static_cast<double>(schedule_.phase)));
  watch();
}

void Session::watch() {
  schedule_.unconverged_in_a_row = report_.solver.converged ? 0 : schedule_.unconverged_in_a_row + 1;
  const GuardValues values = guard_values(world_, report_, schedule_.unconverged_in_a_row, scenario_);
  const GuardValues limits = guard_limits(scenario_);
  for (std::size_t k = 0; k < guard_count; ++k) {
    if (values[k] <= limits[k]) continue;
    if (scenario_.guards.action == scenario::GuardAction::warn) {
      if (schedule_.warnings.steps[k]++ == 0) schedule_.warnings.first[k] = world_.step;
    } else {
      schedule_.broken[k] = values[k];
    }
  }
}

ObservableRow Session::row() const {
  return measure(
      world_, {.baseline = schedule_.baseline,
               .law = law_of_last_step(),
               .surface_displacement = schedule_.surface_displacement,
               .largest_overlap = schedule_.last.largest_overlap.value_or(not_known),
               .residual = schedule_.residual_since_row > 0.0 ? schedule_.residual_since_row
                                                              : schedule_.last.residual.value_or(not_known),
               .at_rest = is_at_rest()});
}

void Session::record_row() {
  segment_.observables.push_back(row());
  schedule_.residual_since_row = 0.0;
  const double volume =
      (1.0 + at(segment_.observables.back(), Observable::volume_strain)) * schedule_.baseline.volume;
  schedule_.surface_height = volume / world_.boundary.length;
}

double Session::tilt_rate() const {
  if (follows_program())
    return radians(program_.segment_of(schedule_.tilt_steps + 1).step) / scenario::time_step(scenario_);
  return schedule_.course ? schedule_.course->rate : radians(scenario_.tilt.rate);
}

Session Session::copy() const { return {scenario_, checkpoint(0.0)}; }

io::Checkpoint Session::checkpoint(double seconds_writing) const {
  io::Checkpoint checkpoint;
  checkpoint.world = world_;
  store_schedule(schedule_, follows_failure(scenario_), checkpoint);
  checkpoint.timing.emplace_back("write", seconds_writing);
  return checkpoint;
}

}  // namespace talus::session
