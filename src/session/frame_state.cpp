#include "session/frame_state.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <utility>

#include "base/errors.h"
#include "base/text.h"
#include "core/trigonometry.h"
#include "dynamics/failure.h"
#include "scenario/text.h"
#include "scenario/tilt_program.h"
#include "session/command.h"
#include "session/deposition.h"
#include "session/run_header.h"
#include "session/session.h"

namespace talus::session {

namespace {

constexpr double same_tilt = 1e-9;     // rad
constexpr double fastest_grain = 1e6;  // sqrt(g D)
constexpr double farthest_held = 1e6;  // D

/// A start and the means to reject it.
struct CheckedStart {
  const io::BranchOrigin& branch;
  const Scenario& scenario;
  const std::string& file;

  const World& world() const { return branch.start.world; }
  template <typename... Args>
  void require(bool holds, const char* data_set, fmt::format_string<Args...> fault, Args&&... args) const {
    if (!holds)
      throw Error(ExitCode::bad_data, "{}: data set /branch/{} {}", file, data_set,
                  fmt::format(fault, std::forward<Args>(args)...));
  }
};

void check_boundary(const CheckedStart& start) {
  const Boundary expected = boundary_of(start.scenario), &found = start.world().boundary;
  const auto same = [](const Plane& one, const Plane& other) {
    return one.normal.x == other.normal.x && one.normal.y == other.normal.y && one.offset == other.offset &&
           one.wall == other.wall;
  };
  start.require(found.periodic == expected.periodic, "periodic",
                "is not that of the scenario (bed.boundary)");
  start.require(found.length == expected.length, "length", "is not that of the scenario (bed.length)");
  start.require(std::ranges::equal(found.planes, expected.planes, same), "plane_normal",
                "and related data are not the walls and the floor of the scenario (bed.boundary, bed.floor)");
}

void check_velocities(const CheckedStart& start) {
  const Grains& grains = start.world().grains;
  const double limit = fastest_grain * std::sqrt(start.world().gravity * start.scenario.grains.mean_diameter);
  const auto check = [&](const char* name, const std::vector<double>& values, bool of_rim) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double velocity = of_rim ? grains.radius[i] * values[i] : values[i];
      start.require(std::abs(velocity) <= limit, name, "moves grain {} at {} m/s, expected at most {} m/s", i,
                    scenario::short_text(velocity), scenario::short_text(limit));
    }
  };
  check("vx", grains.vx, false);
  check("vy", grains.vy, false);
  check("omega", grains.omega, true);
}

void check_phase(const CheckedStart& start, const Schedule& schedule) {
  const std::int64_t steps = start.world().step;
  start.require(schedule.phase == Phase::tilt || schedule.phase == Phase::flow, "integers/phase",
                "is {}, but a branch starts in the tilt (1) or in the flow after failure (3)",
                static_cast<int>(schedule.phase));
  start.require(schedule.phase == Phase::tilt || (follows_failure(start.scenario) && schedule.flow.failed),
                "integers/phase", "is that of a flow after failure, which this run does not have");
  start.require(schedule.tilt_steps <= steps && schedule.flow_steps <= steps - schedule.tilt_steps,
                "integers/tilt_steps", "is {}, of {} steps in total", schedule.tilt_steps, steps);
  start.require(schedule.quiet_steps <= steps, "integers/quiet_steps", "is {}, of {} steps in total",
                schedule.quiet_steps, steps);
  start.require(schedule.baseline.volume > 0.0, "reals/baseline_volume", "is {}, expected a volume above 0",
                scenario::short_text(schedule.baseline.volume));
}

/// Checks the tilt, which follows from the scenario, the number of steps, and the commands.
void check_tilt(const CheckedStart& start, const Schedule& schedule) {
  const scenario::TiltProgram program(start.scenario);
  const std::int64_t last = schedule.last_tilt_step.value_or(0);
  start.require(schedule.last_tilt_step.has_value() != program.empty(), "integers/last_tilt_step",
                "is {} programme of the tilt",
                program.empty() ? "present, but the scenario has no" : "missing, but the scenario has a");
  start.require(last <= start.world().step, "integers/last_tilt_step", "is {}, after {} steps", last,
                start.world().step);
  if (schedule.course)
    start.require(schedule.course->since <= schedule.tilt_steps, "integers/tilt_since",
                  "is {}, after {} steps of the tilt", schedule.course->since, schedule.tilt_steps);
  if (schedule.phase != Phase::tilt) return;
  const double expected = scheduled_tilt(start.scenario, program, schedule);
  start.require(std::abs(start.world().tilt - expected) <= same_tilt, "tilt",
                "is {} deg, but the scenario has {} deg after its {} steps of the tilt",
                scenario::short_text(degrees(start.world().tilt)), scenario::short_text(degrees(expected)),
                schedule.tilt_steps);
}

/// Checks that settings of commands are values that a command can set.
void check_commanded(const CheckedStart& start, const Schedule& schedule) {
  const auto check = [&](const Command& command, const char* data_set) {
    try {
      check_command(command, start.scenario, start.world());
    } catch (const Error& error) {
      start.require(false, data_set, "cannot be set by a command: {}", error.what());
    }
  };
  if (schedule.friction) check({0, CommandKind::friction, -1, *schedule.friction}, "reals/friction");
  if (schedule.course) {
    const double rounded = degrees(schedule.course->rate) * (1.0 - 1e-12);
    check({0, CommandKind::tilt_rate, -1, rounded}, "reals/tilt_rate");
  }
  if (!schedule.drag) return;
  const double farthest = farthest_held * start.scenario.grains.mean_diameter;
  start.require(std::abs(schedule.drag->x) <= farthest, "reals/drag_x", "is too far away");
  start.require(std::abs(schedule.drag->y) <= farthest, "reals/drag_y", "is too far away");
}

}  // namespace

void check_branch_start(const io::BranchOrigin& branch, const Scenario& scenario, const std::string& file) {
  const Schedule schedule =
      stored_schedule(start_of(branch.start), follows_failure(scenario), file, "/branch");
  const CheckedStart start{branch, scenario, file};
  check_boundary(start);
  check_velocities(start);
  check_phase(start, schedule);
  check_tilt(start, schedule);
  check_commanded(start, schedule);
}

namespace {

Contacts memory_of(const FrameContacts& from) {
  return {.a = from.a,
          .b = from.b,
          .shift = from.shift,
          .nx = from.nx,
          .ny = from.ny,
          .gap = std::vector<double>(from.a.size(), 0.0),
          .fn = from.fn,
          .ft = from.ft,
          .moment = from.moment};
}

/// Course of a run, from which its state at a step follows.
class RunCourse {
 public:
  explicit RunCourse(const io::RunFile& run)
      : run_(run),
        scenario_(runs::stored_scenario(run.header(), "/parameters/scenario_resolved")),
        end_(stored_schedule(run.checkpoint(), follows_failure(scenario_), "the run")),
        steps_(run.steps()),
        rows_(run.all_observables()) {}

  const Scenario& scenario() const { return scenario_; }

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
  Schedule start_of_branch() const {
    return stored_schedule(start_of(run_.header().branch->start), follows_failure(scenario_), "the run",
                           "/branch");
  }

  /// Returns only the settings made before a branch started.
  Schedule before_commands() const {
    Schedule schedule;
    if (!run_.header().branch) return schedule;
    const Schedule start = start_of_branch();
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
    if (run_.header().branch && step == run_.header().branch->start.world.step) return start_of_branch().last;
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
    // In these cases the last row of the tilt is that of the failure.
    if (follows_failure(scenario_) || !scenario_.tilt.end_angle) {
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
  Scenario scenario_;
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

io::Checkpoint checkpoint_at_frame(const io::RunFile& run, std::size_t k, const Scenario* branch) {
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
    throw Error(ExitCode::usage, "the run ends with its frame at {} deg: a branch starts from an earlier one",
                degrees_text(checkpoint.world.tilt, 3));
  const Scenario& next = branch != nullptr ? *branch : course.scenario();
  // Moments begin at 0 where rolling friction begins or is too small for them, and end where it ends.
  const double mu_r = next.contact.rolling_friction, before = course.scenario().contact.rolling_friction;
  Contacts& contacts = checkpoint.world.contacts;
  if (before == 0.0 || mu_r < before) contacts.moment.assign(mu_r > 0.0 ? contacts.a.size() : 0, 0.0);
  if (!next.commands.empty()) course.follow_script(checkpoint.world.step, schedule);
  store_schedule(schedule, follows_failure(next), checkpoint);
  return checkpoint;
}

}  // namespace talus::session
