#include "session/command.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <fmt/core.h>
#include <optional>

#include "core/errors.h"
#include "session/drag.h"

namespace talus {
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

void check_push(const Command& command, const Scenario& scenario, const World& world) {
  check_grain(command, world);
  const double limit = fastest_push * std::sqrt(world.gravity * scenario.grains.mean_diameter);
  const double speed = std::sqrt(command.x * command.x + command.y * command.y);
  if (!(speed < limit))
    refuse(command, fmt::format("speed {:.4g} m/s", speed),
           fmt::format("less than 100 sqrt(g D) = {:.4g} m/s", limit));
}

void check_drop(const Command& command, const Scenario& scenario, const World& world) {
  if (command.grain < 1 || command.grain > most_dropped)
    refuse(command, fmt::format("{} grains", command.grain), fmt::format("1 ... {}", most_dropped));
  if (!std::isfinite(command.x))
    refuse(command, fmt::format("x = {:.4g} m", command.x), "a place on the bed");
  if (!world.boundary.periodic) check_range(command, "x =", command.x, world.boundary.length, " m");
  check_range(command, "height", command.y, highest_drop * scenario.grains.mean_diameter, " m");
}

void check_drag(const Command& command, const Scenario& scenario, const World& world) {
  check_grain(command, world);
  const double farthest = farthest_drag * scenario.grains.mean_diameter;
  const Vec2 way = way_of_drag({command.grain, command.x, command.y}, world);
  const double distance = std::sqrt(way.x * way.x + way.y * way.y);
  if (!(distance <= farthest))
    refuse(command, fmt::format("held {:.4g} m from the grain", distance),
           fmt::format("at most {:g} D = {:.4g} m", farthest_drag, farthest));
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

void check_command(const Command& command, const Scenario& scenario, const World& world) {
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

}  // namespace talus
