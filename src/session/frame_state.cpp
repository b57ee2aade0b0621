#include "session/frame_state.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <utility>

#include "base/errors.h"
#include "base/text.h"
#include "core/trigonometry.h"
#include "dynamics/failure.h"
#include "scenario/tilt_program.h"
#include "session/run_header.h"
#include "session/session.h"

namespace talus::session {
namespace {

Contacts memory_of(const FrameContacts& from) {
  Contacts contacts;
  contacts.a = from.a;
  contacts.b = from.b;
  contacts.shift = from.shift;
  contacts.nx = from.nx;
  contacts.ny = from.ny;
  contacts.gap.assign(from.a.size(), 0.0);
  contacts.fn = from.fn;
  contacts.ft = from.ft;
  contacts.moment = from.moment;
  return contacts;
}

/// Course of a run, from which its state at a step follows.
class RunCourse {
 public:
  explicit RunCourse(const io::RunFile& run)
      : run_(run),
        scenario_(runs::stored_scenario(run.header(), "/parameters/scenario_resolved")),
        end_(stored_schedule(run.checkpoint(), follows_failure(), "the run")),
        steps_(run.steps()),
        rows_(run.all_observables()) {}

  const scenario::Scenario& scenario() const { return scenario_; }
  bool follows_failure() const { return scenario_.tilt.after_failure != scenario::AfterFailure::stop; }

  /// Returns the settings at a step. `turns`, if given, receives the tilts at which commands set the rate.
  Schedule commanded(std::int64_t step, std::vector<double>* turns = nullptr) const {
    const scenario::TiltProgram program(scenario_);
    Schedule schedule = before_commands();
    for (const Command& command : run_.commands()) {
      if (command.step >= step) break;
      schedule.tilt_steps = tilt_steps(command.step);
      if (command.kind == CommandKind::tilt_rate)
        schedule.course =
            TiltCourse{radians(command.x), scheduled_tilt(scenario_, program, schedule), schedule.tilt_steps};
      if (turns != nullptr && command.kind == CommandKind::tilt_rate) turns->push_back(schedule.course->from);
      if (command.kind == CommandKind::drag) schedule.drag = Drag{command.grain, command.x, command.y};
      if (command.kind == CommandKind::release) schedule.drag.reset();
    }
    schedule.friction = run_.commanded_friction(step);
    return schedule;
  }

  Schedule at_step(std::int64_t step, const World& world) const {
    Schedule schedule = commanded(step);
    const auto next = first_after(step);
    schedule.phase = next == steps_.end() ? end_.phase : static_cast<Phase>(at(*next, StepField::phase));
    schedule.tilt_steps = tilt_steps(step);
    schedule.flow_steps = end_.flow_steps - steps_after(step, Phase::flow);
    schedule.baseline = end_.baseline;
    if (end_.last_tilt_step) schedule.last_tilt_step = std::min(step, *end_.last_tilt_step);
    const double rest_velocity =
        scenario_.deposition.rest_velocity * run_.header().statics.gravity * scenario::time_step(scenario_);
    schedule.quiet_steps = rows_in_a_row(step, [rest_velocity](const StepRow& row) {
      return at(row, StepField::rms_velocity) <= rest_velocity;
    });
    schedule.unconverged_in_a_row =
        rows_in_a_row(step, [](const StepRow& row) { return at(row, StepField::converged) == 0.0; });
    if (const auto row = row_at(step); row != rows_.end())
      schedule.surface_displacement = at(*row, Observable::surface_displacement);
    schedule.flow = flow_at(step, world, schedule.phase);
    schedule.last = last_step(step);
    return schedule;
  }

  /// Sets how far the commands of the scenario had advanced before the last step: commands due at the state
  /// after it are still to be carried out. There is a row wherever a programme turns, and between two rows
  /// and the commands that set the rate the tilt is monotone.
  void follow_script(std::int64_t step, Schedule& schedule) const {
    const std::int64_t steps = schedule.tilt_steps + schedule.flow_steps - 1;
    if (steps < 0) return;
    ScriptCourse course = schedule.script.value_or(ScriptCourse());
    const auto reach = [&course](double tilt) {
      course.highest = std::max(course.highest, tilt);
      course.lowest = std::min(course.lowest, tilt);
    };
    for (const ObservableRow& row : rows_)
      if (at(row, Observable::step) < static_cast<double>(step)) reach(at(row, Observable::tilt));
    std::vector<double> turns;
    commanded(step, &turns);
    for (const double tilt : turns) reach(tilt);
    Schedule before = schedule;
    if (--before.tilt_steps >= 0 && schedule.phase == Phase::tilt)
      reach(scheduled_tilt(scenario_, scenario::TiltProgram(scenario_), before));
    course.steps = steps;
    schedule.script = course;
  }

 private:
  /// Returns only the settings made before a branch started.
  Schedule before_commands() const {
    Schedule schedule;
    if (!run_.header().branch) return schedule;
    const Schedule start =
        stored_schedule(start_of(run_.header().branch->start), follows_failure(), "the run", "/branch");
    schedule.deposition_friction = start.deposition_friction;
    schedule.course = start.course;
    schedule.drag = start.drag;
    schedule.script = start.script;
    return schedule;
  }

  std::vector<StepRow>::const_iterator first_after(std::int64_t step) const {
    return std::ranges::upper_bound(steps_, static_cast<double>(step), {},
                                    [](const StepRow& row) { return at(row, StepField::step); });
  }

  std::int64_t steps_after(std::int64_t step, Phase phase) const {
    return std::count_if(first_after(step), steps_.end(), [phase](const StepRow& row) {
      return at(row, StepField::phase) == static_cast<double>(phase);
    });
  }

  std::int64_t tilt_steps(std::int64_t step) const {
    return end_.tilt_steps - steps_after(step, Phase::tilt);
  }

  template <typename Holds>
  std::int64_t rows_in_a_row(std::int64_t step, const Holds& holds) const {
    std::int64_t count = 0;
    for (auto row = first_after(step); row != steps_.begin() && holds(*(row - 1)); --row) ++count;
    return count;
  }

  /// Returns the last row not after a step.
  std::vector<ObservableRow>::const_iterator row_at(std::int64_t step) const {
    const auto after =
        std::ranges::upper_bound(rows_, static_cast<double>(step), {},
                                 [](const ObservableRow& row) { return at(row, Observable::step); });
    return after == rows_.begin() ? rows_.end() : after - 1;
  }

  /// Returns what the run recorded of the step that led to a state.
  LastStep last_step(std::int64_t step) const {
    if (step == run_.checkpoint().world.step) return end_.last;
    const std::optional<io::BranchOrigin>& branch = run_.header().branch;
    if (branch && step == branch->start.world.step)
      return stored_schedule(start_of(branch->start), follows_failure(), "the run", "/branch").last;
    LastStep last;
    if (const auto row = row_at(step);
        row != rows_.end() && at(*row, Observable::step) == static_cast<double>(step))
      last.largest_overlap = at(*row, Observable::largest_overlap);
    if (const auto next = first_after(step);
        next != steps_.begin() && at(*(next - 1), StepField::step) == static_cast<double>(step)) {
      last.residual = at(*(next - 1), StepField::residual);
      last.converged = at(*(next - 1), StepField::converged);
    }
    return last;
  }

  /// Returns the progress, by the rows, of the flow that failed the slope at or after this step.
  dynamics::SurfaceFlow flow_at(std::int64_t step, const World& world, Phase phase) const {
    if (!end_.flow.failed) return {};
    if (phase == Phase::flow) return end_.flow;
    auto row = row_at(step);
    if (row == rows_.end()) return {};
    const double now = at(*row, Observable::surface_displacement);
    if (follows_failure() || !scenario_.tilt.end_angle) {  // the last row of the tilt is that of the failure
      const auto last = row_at(run_.checkpoint().world.step - end_.flow_steps);
      dynamics::SurfaceFlow flow = end_.flow;
      flow.displacement -= std::abs(at(*last, Observable::surface_displacement) - now);
      flow.failed = row == last;
      return flow.displacement > 0.0 ? flow : dynamics::SurfaceFlow{};
    }
    if (std::abs(world.tilt) < end_.flow.onset_tilt) return {};
    while (row != rows_.begin() && std::abs(at(*row, Observable::tilt)) > end_.flow.onset_tilt) --row;
    dynamics::SurfaceFlow flow{.flowing = true, .onset_tilt = end_.flow.onset_tilt};
    flow.displacement = std::abs(now - at(*row, Observable::surface_displacement));
    const RunStatics& statics = run_.header().statics;
    flow.failed = flow.displacement >=
                  dynamics::flow_rule(statics.mean_diameter, statics.gravity, world.boundary).distance;
    return flow;
  }

  const io::RunFile& run_;
  scenario::Scenario scenario_;
  Schedule end_;
  std::vector<StepRow> steps_;
  std::vector<ObservableRow> rows_;
};

/// Throws if a repaired run has lost steps, rows of observables or commands, because its state at a frame is
/// then unknown.
void require_course(const io::RunFile& run) {
  const std::string lost = run.lost();
  if (lost.empty()) return;
  const std::int64_t begun = run.header().branch ? run.header().branch->start.world.step : 0;
  const auto steps = static_cast<std::int64_t>(run.steps().size());
  if (run.checkpoint().world.step - begun == steps && !may_lack_commands(run) &&
      lost.find("/observables") == std::string::npos)
    return;
  throw Error(ExitCode::bad_data,
              "the run was repaired, and some of its steps, observables or commands are lost, so its state "
              "at a frame is unknown: no branch can start there");
}

/// Wraps grains whose x equals the period, which can occur in single precision.
void wrap_rounded(World& world) {
  Grains& grains = world.grains;
  for (Index i = 0; i < grains.free_count && world.boundary.periodic; ++i)
    if (grains.x[i] >= world.boundary.length) {
      grains.x[i] -= world.boundary.length;
      ++grains.image[i];
    }
}

}  // namespace

bool may_lack_commands(const io::RunFile& run) {
  const std::string lost = run.lost();
  const auto names = {"/commands", "/branch", "/contents", "segment_"};
  return std::ranges::any_of(names,
                             [&lost](const char* name) { return lost.find(name) != std::string::npos; });
}

std::int64_t steps_before_tilt(const io::RunFile& run) {
  if (run.header().branch) {
    const io::Checkpoint& start = run.header().branch->start;
    return start.world.step - find_value(start.integers, "tilt_steps").value_or(0) -
           find_value(start.integers, "flow_steps").value_or(0);
  }
  return run.all_frame_tilts().empty() ? 0 : run.instant(0).step;
}

World world_at_frame(const io::RunFile& run, std::size_t k) {
  if (!run.has_state())
    throw Error(ExitCode::bad_data,
                "the run was repaired and its last state is lost; without it no step can be formed");
  World world = run.checkpoint().world;
  Frame frame = run.frame(k);
  if (frame.step == world.step) return world;
  world.grains.x = std::move(frame.x);
  world.grains.y = std::move(frame.y);
  world.grains.vx = std::move(frame.vx);
  world.grains.vy = std::move(frame.vy);
  world.grains.omega = std::move(frame.omega);
  world.grains.angle = std::move(frame.angle);
  world.grains.image = std::move(frame.image);
  world.contacts = memory_of(frame.contacts);
  world.tilt = frame.tilt;
  world.time = frame.time;
  world.step = frame.step;
  return world;
}

Schedule commanded_schedule(const io::RunFile& run, std::int64_t step) {
  return RunCourse(run).commanded(step);
}

io::Checkpoint start_of(io::Checkpoint start) {
  io::Checkpoint none;
  store_schedule({}, true, none);
  start.results = none.results;
  return start;
}

io::Checkpoint checkpoint_at_frame(const io::RunFile& run, std::size_t k, const scenario::Scenario* branch) {
  io::Checkpoint checkpoint;
  checkpoint.world = world_at_frame(run, k);
  require_course(run);
  wrap_rounded(checkpoint.world);
  const RunCourse course(run);
  Schedule schedule = course.at_step(checkpoint.world.step, checkpoint.world);
  if (!run.header().branch) schedule.deposition_friction = run.commanded_friction(run.instant(0).step);
  schedule.last.friction = run.friction_of_frame(k).grains;
  schedule.last.wall_friction = run.friction_of_frame(k).walls;
  if (schedule.phase == Phase::done)
    throw Error(ExitCode::usage,
                fmt::format("the run ends with its frame at {} deg: a branch starts from an earlier one",
                            degrees_text(checkpoint.world.tilt, 3)));
  const scenario::Scenario& next = branch != nullptr ? *branch : course.scenario();
  if (!next.commands.empty()) course.follow_script(checkpoint.world.step, schedule);
  store_schedule(schedule, next.tilt.after_failure != scenario::AfterFailure::stop, checkpoint);
  return checkpoint;
}

}  // namespace talus::session
