#include "session/command.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fmt/core.h>
#include <optional>

#include "base/errors.h"
#include "core/trigonometry.h"
#include "session/drag.h"

namespace talus::session {
namespace {

constexpr double fastest_push = 100.0;  // sqrt(g D)
constexpr Index most_dropped = 1000;    // grains
constexpr double highest_drop = 100.0;  // D
constexpr double fastest_tilt = 100.0;  // deg/s

constexpr std::array<std::string_view, command_kind_count> names = {"push",      "drop", "friction",
                                                                    "tilt_rate", "drag", "release"};

[[noreturn]] void refuse(const Command& command, const std::string& found, const std::string& expected) {
  throw Error(ExitCode::usage, fmt::format("{}: {}, expected {}", name_of(command.kind), found, expected));
}

void check_range(const Command& command, const char* name, double value, double highest, const char* unit) {
  if (value >= 0.0 && value <= highest) return;  // not for NaN
  refuse(command, fmt::format("{} {:.4g}{}", name, value, unit),
         fmt::format("0 ... {:.4g}{}", highest, unit));
}

void check_grain(const Command& command, const World& world) {
  if (command.grain < 0 || command.grain >= world.grains.free_count)
    refuse(command, fmt::format("grain {}", command.grain),
           fmt::format("a free grain, 0 ... {}", world.grains.free_count - 1));
}

void check_push(const Command& command, const scenario::Scenario& scenario, const World& world) {
  check_grain(command, world);
  const double limit = fastest_push * std::sqrt(world.gravity * scenario.grains.mean_diameter);
  const double speed = std::sqrt(command.x * command.x + command.y * command.y);
  if (!(speed < limit))
    refuse(command, fmt::format("speed {:.4g} m/s", speed),
           fmt::format("less than 100 sqrt(g D) = {:.4g} m/s", limit));
}

void check_drop(const Command& command, const scenario::Scenario& scenario, const World& world) {
  if (command.grain < 1 || command.grain > most_dropped)
    refuse(command, fmt::format("{} grains", command.grain), fmt::format("1 ... {}", most_dropped));
  if (!std::isfinite(command.x))
    refuse(command, fmt::format("x = {:.4g} m", command.x), "a place on the bed");
  if (!world.boundary.periodic) check_range(command, "x =", command.x, world.boundary.length, " m");
  check_range(command, "height", command.y, highest_drop * scenario.grains.mean_diameter, " m");
}

void check_drag(const Command& command, const scenario::Scenario& scenario, const World& world) {
  check_grain(command, world);
  const double farthest = farthest_drag * scenario.grains.mean_diameter;
  const Vec2 way = way_of_drag({command.grain, command.x, command.y}, world);
  const double distance = std::sqrt(way.x * way.x + way.y * way.y);
  if (!(distance <= farthest))
    refuse(command, fmt::format("held {:.4g} m from the grain", distance),
           fmt::format("at most {:g} D = {:.4g} m", farthest_drag, farthest));
}

/// The rows around a step: the last one up to it, and the first one after it, or the same one at the end of
/// the run. None before the first row.
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

/// A value that goes from one place to another linearly in the steps.
double between(double step, double first, double first_value, double last, double last_value) {
  return step <= first || last <= first
             ? first_value
             : first_value + (last_value - first_value) * ((step - first) / (last - first));
}

}  // namespace

std::string_view name_of(CommandKind kind) { return names.at(static_cast<std::size_t>(kind)); }

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
      return "let go of the grain";
    case CommandKind::tilt_rate:
      break;
  }
  return command.x == 0.0 ? "hold the tilt" : fmt::format("tilt rate {:.4g} deg/s", command.x);
}

void check_command(const Command& command, const scenario::Scenario& scenario, const World& world) {
  switch (command.kind) {
    case CommandKind::push:
      return check_push(command, scenario, world);
    case CommandKind::drop:
      return check_drop(command, scenario, world);
    case CommandKind::friction:
      return check_range(command, "coefficient", command.x, largest_friction, "");
    case CommandKind::tilt_rate:
      return check_range(command, "rate", command.x, fastest_tilt, " deg/s");
    case CommandKind::drag:
      return check_drag(command, scenario, world);
    case CommandKind::release:
      return;
  }
}

std::vector<Command> given_commands(std::span<const Command> commands) {
  std::vector<Command> given;
  std::optional<Index> dragged;
  for (const Command& command : commands) {
    const bool goes_on = command.kind == CommandKind::drag && dragged == command.grain;
    if (command.kind == CommandKind::drag) dragged = command.grain;
    if (command.kind == CommandKind::release) dragged.reset();
    if (!goes_on && command.kind != CommandKind::release) given.push_back(command);
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
  // Back from the row after: each command that set the rate says what the tilt did until there.
  for (auto of = commands.rbegin(); of != commands.rend(); ++of) {
    const auto set = static_cast<double>(of->step);
    if (of->kind != CommandKind::tilt_rate || set <= first || set >= last) continue;
    const double tilt = last_tilt - radians(of->x) * h * (last - set);
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
