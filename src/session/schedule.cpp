#include "session/schedule.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <limits>
#include <type_traits>
#include <variant>

#include "base/errors.h"
#include "core/trigonometry.h"
#include "scenario/text.h"

namespace talus::session {

namespace {

constexpr double max_steps = 0x1p53;  // step counts up to this are exact in a double

/// Group of a checkpoint that holds a value. Those of `timing` are not state, and may be missing.
enum class CheckpointGroup { integers, reals, results, timing };

enum class StoragePolicy {
  always,
  where_not_zero,  ///< a missing value is zero
  as_result,       ///< derived from others: written, never read
  where_known,     ///< not state; an unknown value is missing
};

/// A value of the schedule (an empty one is stored as NaN), or a derived result.
using Value = std::variant<Phase*, std::int64_t*, Index*, bool*, double*, std::optional<double>*, double>;

struct ScheduleField {
  CheckpointGroup place;
  std::string name;
  Value value;
  StoragePolicy kept = StoragePolicy::always;
};

double count(std::int64_t steps) { return static_cast<double>(steps); }

/// Returns the table of all values that a checkpoint holds of a schedule. Values of a command are included if
/// it was given.
std::vector<ScheduleField> fields(Schedule& s, bool follows) {
  using enum CheckpointGroup;
  using enum StoragePolicy;
  std::vector<ScheduleField> all = {
      {integers, "phase", &s.phase},
      {integers, "tilt_steps", &s.tilt_steps},
      {integers, "quiet_steps", &s.quiet_steps},
      {integers, "flowing", &s.flow.flowing},
      {integers, "failed", &s.flow.failed},
      {integers, "unconverged_deposition", &s.record.unconverged_deposition},
      {integers, "unconverged_tilt", &s.record.unconverged_tilt},
      {reals, "baseline_volume", &s.baseline.volume},
      {reals, "baseline_centre_of_mass_height", &s.baseline.centre_of_mass_height},
      {reals, "onset_tilt", &s.flow.onset_tilt},
      {reals, "flow_displacement", &s.flow.displacement},
      {reals, "surface_height", &s.surface_height},
      {reals, "surface_displacement", &s.surface_displacement},
      {reals, "residual_since_row", &s.residual_since_row},
      {results, "theta_c", angle_of_repose(s).value_or(not_known), as_result},
      {results, "residual_max", std::max(s.record.residual_max_rest, s.record.residual_max_moving),
       as_result},
      {results, "residual_max_rest", &s.record.residual_max_rest},
      {results, "residual_max_moving", &s.record.residual_max_moving},
      {results, "unconverged_steps_deposition", count(s.record.unconverged_deposition), as_result},
      {results, "unconverged_steps", count(s.record.unconverged_tilt), as_result},
      {timing, "deposition", &s.seconds.deposition},
      {timing, "tilt", &s.seconds.tilt},
  };
  if (s.friction) all.push_back({reals, "friction", &*s.friction});
  if (s.course) {
    all.push_back({reals, "tilt_rate", &s.course->rate});
    all.push_back({reals, "tilt_from", &s.course->from});
    all.push_back({integers, "tilt_since", &s.course->since});
  }
  if (s.drag) {
    all.push_back({integers, "drag_grain", &s.drag->grain});
    all.push_back({reals, "drag_x", &s.drag->x});
    all.push_back({reals, "drag_y", &s.drag->y});
  }
  if (s.script) {
    all.push_back({reals, "script_highest", &s.script->highest});
    all.push_back({reals, "script_lowest", &s.script->lowest});
    all.push_back({integers, "script_steps", &s.script->steps});
  }
  if (s.last_tilt_step) all.push_back({integers, io::last_tilt_step_name, &*s.last_tilt_step});
  all.push_back({integers, "unconverged_in_a_row", &s.unconverged_in_a_row, where_not_zero});
  for (std::size_t k = 0; k < guard_count; ++k) {
    const std::string name = std::string("warnings_").append(guard_names[k]);
    all.push_back({results, name, &s.warnings.steps[k], where_not_zero});
    all.push_back({results, name + "_first_step", &s.warnings.first[k], where_not_zero});
    all.push_back({reals, std::string("broken_").append(guard_names[k]), &s.broken[k], where_not_zero});
  }
  all.push_back({reals, "deposition_friction", &s.deposition_friction, where_known});
  all.push_back({reals, "last_largest_overlap", &s.last.largest_overlap, where_known});
  all.push_back({reals, "last_residual", &s.last.residual, where_known});
  all.push_back({reals, "last_converged", &s.last.converged, where_known});
  all.push_back({reals, "last_friction", &s.last.friction, where_known});
  all.push_back({reals, "last_wall_friction", &s.last.wall_friction, where_known});
  if (follows) {
    all.push_back({integers, io::flow_steps_name, &s.flow_steps});
    all.push_back({integers, "unconverged_flow", &s.record.unconverged_flow});
    all.push_back({results, "theta_r", &s.angle_at_rest});
    all.push_back({results, "unconverged_steps_flow", count(s.record.unconverged_flow), as_result});
  }
  for (std::size_t k = 0; k < dynamics::stage_count; ++k)
    all.push_back({timing, std::string("stage_").append(dynamics::stage_names[k]), &s.seconds.stages[k]});
  return all;
}

double number_of(const Value& value) {
  return std::visit(
      [](auto alternative) -> double {
        if constexpr (std::is_same_v<decltype(alternative), double>)
          return alternative;
        else if constexpr (std::is_same_v<decltype(alternative), std::optional<double>*>)
          return alternative->value_or(not_known);
        else
          return static_cast<double>(*alternative);
      },
      value);
}

/// Returns the list of numbers of a group; not for integers.
auto& reals_at(CheckpointGroup place, auto& checkpoint) {
  return place == CheckpointGroup::reals     ? checkpoint.reals
         : place == CheckpointGroup::results ? checkpoint.results
                                             : checkpoint.timing;
}

std::optional<double> find(const ScheduleField& field, const io::Checkpoint& checkpoint) {
  if (field.place != CheckpointGroup::integers)
    return find_value(reals_at(field.place, checkpoint), field.name);
  const std::optional<std::int64_t> found = find_value(checkpoint.integers, field.name);
  return found ? std::optional(static_cast<double>(*found)) : std::nullopt;
}

/// Origin of a checkpoint, for messages: the file, and the group in it.
struct CheckpointOrigin {
  const std::string& file;
  const std::string& group;
};

[[noreturn]] void refuse(const ScheduleField& field, const CheckpointOrigin& origin,
                         const std::string& fault) {
  const std::string groups[] = {origin.group + "/integers/", origin.group + "/reals/", "/results/",
                                "/provenance/timing/"};
  throw Error(ExitCode::bad_data, "{}: data set {}{} {}", origin.file,
              groups[static_cast<std::size_t>(field.place)], field.name, fault);
}

/// Sets the value of a field, or throws if it is impossible.
void take(double number, const ScheduleField& field, const io::Checkpoint& checkpoint,
          const CheckpointOrigin& origin) {
  const auto check = [&](double most, const char* expected) {
    if (!(number >= 0.0 && number <= most))
      refuse(field, origin, fmt::format("is {}, expected {}", scenario::short_text(number), expected));
  };
  if (Phase* const* phase = std::get_if<Phase*>(&field.value)) {
    check(static_cast<double>(Phase::flow), "0, 1, 2 or 3");
    **phase = static_cast<Phase>(static_cast<std::int64_t>(number));
  } else if (std::int64_t* const* steps = std::get_if<std::int64_t*>(&field.value)) {
    check(max_steps, "a number of steps");
    **steps = static_cast<std::int64_t>(number);
  } else if (Index* const* grain = std::get_if<Index*>(&field.value)) {
    check(static_cast<double>(checkpoint.world.grains.free_count) - 1.0, "a free grain");
    **grain = static_cast<Index>(number);
  } else if (bool* const* flag = std::get_if<bool*>(&field.value)) {
    **flag = number != 0.0;
  } else if (double* const* real = std::get_if<double*>(&field.value)) {
    if (field.place == CheckpointGroup::reals && !std::isfinite(number))
      refuse(field, origin, fmt::format("is {}, expected a finite number", scenario::short_text(number)));
    **real = number;
  } else if (std::optional<double>* const* real_or_none = std::get_if<std::optional<double>*>(&field.value)) {
    if (field.kept == StoragePolicy::where_known)
      check(std::numeric_limits<double>::max(), "a number, 0 or more");
    if (!std::isnan(number)) **real_or_none = number;
  }
}

}  // namespace

std::optional<double> angle_of_repose(const Schedule& schedule) {
  return schedule.flow.failed ? std::optional<double>(schedule.flow.onset_tilt) : std::nullopt;
}

bool is_reached(const scenario::ScriptedCommand& command, const Scenario& scenario,
                const std::optional<ScriptCourse>& course) {
  if (!course) return false;
  if (!command.at)
    return std::llround(command.time.value_or(0.0) / scenario::time_step(scenario)) <= course->steps;
  constexpr double rounding = 1e-9;  // rad, because a tilt is a sum of steps
  const double angle = radians(*command.at);
  return angle < 0.0 ? course->lowest <= angle + rounding : course->highest >= angle - rounding;
}

std::vector<std::size_t> waiting_commands(const Scenario& scenario, const Schedule& schedule) {
  std::vector<std::size_t> waiting;
  for (std::size_t k = 0; k < scenario.commands.size(); ++k)
    if (!is_reached(scenario.commands[k], scenario, schedule.script)) waiting.push_back(k);
  return waiting;
}

void store_schedule(Schedule schedule, bool follows, io::Checkpoint& checkpoint) {
  for (const ScheduleField& field : fields(schedule, follows)) {
    const double number = number_of(field.value);
    if (field.kept == StoragePolicy::where_not_zero && number == 0.0) continue;
    if (field.kept == StoragePolicy::where_known && !std::isfinite(number)) continue;
    if (field.place == CheckpointGroup::integers)
      checkpoint.integers.emplace_back(field.name, static_cast<std::int64_t>(number));
    else
      reals_at(field.place, checkpoint).emplace_back(field.name, number);
  }
}

Schedule stored_schedule(const io::Checkpoint& checkpoint, bool follows, const std::string& file,
                         const std::string& group) {
  const CheckpointOrigin origin{file, group};
  Schedule schedule;
  if (find_value(checkpoint.reals, "friction")) schedule.friction.emplace();
  if (find_value(checkpoint.reals, "tilt_rate")) schedule.course.emplace();
  if (find_value(checkpoint.integers, "drag_grain")) schedule.drag.emplace();
  if (find_value(checkpoint.integers, "script_steps")) schedule.script.emplace();
  if (find_value(checkpoint.integers, io::last_tilt_step_name)) schedule.last_tilt_step.emplace();
  for (const ScheduleField& field : fields(schedule, follows)) {
    if (field.kept == StoragePolicy::as_result) continue;
    if (const std::optional<double> number = find(field, checkpoint))
      take(*number, field, checkpoint, origin);
    else if (field.kept == StoragePolicy::always && field.place != CheckpointGroup::timing)
      refuse(field, origin, "is missing; without it the run cannot continue");
  }
  return schedule;
}

}  // namespace talus::session
