#include "session/branch_start.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "base/errors.h"
#include "core/trigonometry.h"
#include "scenario/text.h"
#include "scenario/tilt_program.h"
#include "session/command.h"
#include "session/deposition.h"
#include "session/frame_state.h"
#include "session/session.h"

namespace talus::session {
namespace {

constexpr double same_tilt = 1e-9;     // rad
constexpr double fastest_grain = 1e6;  // sqrt(g D)
constexpr double farthest_held = 1e6;  // D

/// A start and the means to reject it.
struct CheckedStart {
  const io::BranchOrigin& branch;
  const scenario::Scenario& scenario;
  const std::string& file;

  const World& world() const { return branch.start.world; }
  void require(bool holds, const char* data_set, const std::string& fault) const {
    if (!holds)
      throw Error(ExitCode::bad_data, fmt::format("{}: data set /branch/{} {}", file, data_set, fault));
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
      start.require(std::abs(velocity) <= limit, name,
                    fmt::format("moves grain {} at {} m/s, expected at most {} m/s", i,
                                scenario::short_text(velocity), scenario::short_text(limit)));
    }
  };
  check("vx", grains.vx, false);
  check("vy", grains.vy, false);
  check("omega", grains.omega, true);
}

void check_phase(const CheckedStart& start, const Schedule& schedule) {
  const bool follows = start.scenario.tilt.after_failure != scenario::AfterFailure::stop;
  const std::int64_t steps = start.world().step;
  start.require(schedule.phase == Phase::tilt || schedule.phase == Phase::flow, "integers/phase",
                fmt::format("is {}, but a branch starts in the tilt (1) or in the flow after failure (3)",
                            static_cast<int>(schedule.phase)));
  start.require(schedule.phase == Phase::tilt || (follows && schedule.flow.failed), "integers/phase",
                "is that of a flow after failure, which this run does not have");
  start.require(schedule.tilt_steps <= steps && schedule.flow_steps <= steps - schedule.tilt_steps,
                "integers/tilt_steps",
                fmt::format("is {}, of {} steps in total", schedule.tilt_steps, steps));
  start.require(schedule.quiet_steps <= steps, "integers/quiet_steps",
                fmt::format("is {}, of {} steps in total", schedule.quiet_steps, steps));
  start.require(
      schedule.baseline.volume > 0.0, "reals/baseline_volume",
      fmt::format("is {}, expected a volume above 0", scenario::short_text(schedule.baseline.volume)));
}

/// Checks the tilt, which follows from the scenario, the number of steps, and the commands.
void check_tilt(const CheckedStart& start, const Schedule& schedule) {
  const scenario::TiltProgram program(start.scenario);
  const std::int64_t last = schedule.last_tilt_step.value_or(0);
  start.require(schedule.last_tilt_step.has_value() != program.empty(), "integers/last_tilt_step",
                program.empty() ? "is present, but the scenario has no programme of the tilt"
                                : "is missing, but the scenario has a programme of the tilt");
  start.require(last <= start.world().step, "integers/last_tilt_step",
                fmt::format("is {}, after {} steps", last, start.world().step));
  if (schedule.course)
    start.require(
        schedule.course->since <= schedule.tilt_steps, "integers/tilt_since",
        fmt::format("is {}, after {} steps of the tilt", schedule.course->since, schedule.tilt_steps));
  if (schedule.phase != Phase::tilt) return;
  const double expected = scheduled_tilt(start.scenario, program, schedule);
  start.require(std::abs(start.world().tilt - expected) <= same_tilt, "tilt",
                fmt::format("is {} deg, but the scenario has {} deg after its {} steps of the tilt",
                            scenario::short_text(degrees(start.world().tilt)),
                            scenario::short_text(degrees(expected)), schedule.tilt_steps));
}

/// Checks that settings of commands are values that a command can set.
void check_commanded(const CheckedStart& start, const Schedule& schedule) {
  const auto check = [&](const Command& command, const char* data_set) {
    try {
      check_command(command, start.scenario, start.world());
    } catch (const Error& error) {
      start.require(false, data_set, fmt::format("cannot be set by a command: {}", error.what()));
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

void check_branch_start(const io::BranchOrigin& branch, const scenario::Scenario& scenario,
                        const std::string& file) {
  const bool follows = scenario.tilt.after_failure != scenario::AfterFailure::stop;
  const Schedule schedule = stored_schedule(start_of(branch.start), follows, file, "/branch");
  const CheckedStart start{branch, scenario, file};
  check_boundary(start);
  check_velocities(start);
  check_phase(start, schedule);
  check_tilt(start, schedule);
  check_commanded(start, schedule);
}

}  // namespace talus::session
