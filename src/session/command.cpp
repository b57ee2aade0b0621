#include "session/command.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fmt/core.h>
#include <optional>

#include "base/errors.h"
#include "core/trigonometry.h"
#include "scenario/scripted_command.h"
#include "session/drag.h"

namespace talus::session {
namespace {

[[noreturn]] void refuse(const Command& command, const std::string& fault) {
  throw Error(ExitCode::usage, fmt::format("{}: {}", name_of(command.kind), fault));
}

void check_drag(const Command& command, const scenario::Scenario& scenario, const World& world) {
  const double farthest = farthest_drag * scenario.grains.mean_diameter;
  const Vec2 way = drag_offset({command.grain, command.x, command.y}, world);
  const double distance = std::sqrt(way.x * way.x + way.y * way.y);
  if (!(distance <= farthest))
    refuse(command, fmt::format("held {:.4g} m from the grain, expected at most {:g} D = {:.4g} m", distance,
                                farthest_drag, farthest));
}

/// The last row up to a step and the first row after it, which are the same at the end of the run. None
/// exists before the first row.
struct RowsAround {
  const ObservableRow *before, *after;
};
std::optional<RowsAround> rows_around(std::int64_t step, std::span<const ObservableRow> rows) {
  const auto wanted = static_cast<double>(step);
  const auto after = std::ranges::partition_point(
      rows, [wanted](const ObservableRow& row) { return at(row, Observable::step) <= wanted; });
  if (after == rows.begin()) return std::nullopt;
  const ObservableRow* const before = &*std::prev(after);
  return RowsAround{before, after == rows.end() ? before : &*after};
}

/// Interpolates a value linearly in the steps.
double between(double step, double first, double first_value, double last, double last_value) {
  return step <= first || last <= first
             ? first_value
             : first_value + (last_value - first_value) * ((step - first) / (last - first));
}

}  // namespace

std::string_view name_of(CommandKind kind) { return command_kind_names.at(static_cast<std::size_t>(kind)); }

std::string command_text(const Command& command) {
  switch (command.kind) {
    case CommandKind::push:
      return fmt::format("push grain {} by ({:.4g}, {:.4g}) m/s", command.grain, command.x, command.y);
    case CommandKind::drop:
      return fmt::format("drop {} grains at x = {:.4g} m from {:.4g} m above the surface", command.grain,
                         command.x, command.y);
    case CommandKind::friction:
      return fmt::format("friction {:.4g}", command.x);
    case CommandKind::drag:
      return fmt::format("drag grain {} to ({:.4g}, {:.4g}) m", command.grain, command.x, command.y);
    case CommandKind::release:
      return "release the grain";
    case CommandKind::tilt_rate:
      break;
  }
  return command.x == 0.0 ? "hold the tilt" : fmt::format("tilt rate {:.4g} deg/s", command.x);
}

void check_command(const Command& command, const scenario::Scenario& scenario, const World& world) {
  const std::string fault = scenario::command_fault(command, scenario, world.grains.free_count);
  if (!fault.empty()) refuse(command, fault);
  if (command.kind == CommandKind::drag) check_drag(command, scenario, world);
}

std::vector<Command> given_commands(std::span<const Command> commands) {
  std::vector<Command> given;
  std::optional<Index> dragged;
  for (const Command& command : commands) {
    const bool continues_drag = command.kind == CommandKind::drag && dragged == command.grain;
    if (command.kind == CommandKind::drag) dragged = command.grain;
    if (command.kind == CommandKind::release) dragged.reset();
    if (!continues_drag && command.kind != CommandKind::release) given.push_back(command);
  }
  return given;
}

std::vector<ObservableRow> rows_up_to(std::span<const ObservableRow> rows, std::int64_t step, double time,
                                      double tilt) {
  std::vector<ObservableRow> all(rows.begin(), rows.end());
  if (all.empty() || at(all.back(), Observable::step) >= static_cast<double>(step)) return all;
  ObservableRow& last = all.emplace_back();
  at(last, Observable::step) = static_cast<double>(step);
  at(last, Observable::time) = time;
  at(last, Observable::tilt) = tilt;
  return all;
}

double tilt_before(const Command& command, std::span<const Command> commands,
                   std::span<const ObservableRow> rows) {
  const auto around = rows_around(command.step, rows);
  if (!around) return std::nan("");
  const auto step = static_cast<double>(command.step);
  const double first = at(*around->before, Observable::step);
  double last = at(*around->after, Observable::step), last_tilt = at(*around->after, Observable::tilt);
  const double h =
      (at(*around->after, Observable::time) - at(*around->before, Observable::time)) / (last - first);
  // Proceeds backwards from the later row: each command that set the rate determines the tilt from there on.
  for (auto change = commands.rbegin(); change != commands.rend(); ++change) {
    const auto set = static_cast<double>(change->step);
    if (change->kind != CommandKind::tilt_rate || set <= first || set >= last) continue;
    const double tilt = last_tilt - radians(change->x) * h * (last - set);
    if (set <= step) return between(step, set, tilt, last, last_tilt);
    last = set;
    last_tilt = tilt;
  }
  return between(step, first, at(*around->before, Observable::tilt), last, last_tilt);
}

double time_before(const Command& command, std::span<const ObservableRow> rows) {
  const auto around = rows_around(command.step, rows);
  if (!around) return std::nan("");
  return between(static_cast<double>(command.step), at(*around->before, Observable::step),
                 at(*around->before, Observable::time), at(*around->after, Observable::step),
                 at(*around->after, Observable::time));
}

}  // namespace talus::session
