#include "session/command.h"

#include <array>
#include <cmath>
#include <cstdio>

#include "core/errors.h"

namespace talus {
namespace {

constexpr double fastest_push = 100.0;     // sqrt(g D)
constexpr Index most_dropped = 1000;       // grains
constexpr double highest_drop = 100.0;     // D
constexpr double largest_friction = 10.0;  // 1
constexpr double fastest_tilt = 100.0;     // deg/s

constexpr std::array<std::string_view, command_kind_count> names = {"push", "drop", "friction", "tilt_rate"};

std::string short_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

[[noreturn]] void refuse(const Command& command, const std::string& found, const std::string& expected) {
  throw Error(ExitCode::usage,
              std::string(name_of(command.kind)).append(": ").append(found).append(", expected ") + expected);
}

void check_range(const Command& command, const char* name, double value, double highest, const char* unit) {
  if (value >= 0.0 && value <= highest) return;  // not for NaN
  refuse(command, std::string(name).append(" ").append(short_text(value)).append(unit),
         std::string("0 ... ").append(short_text(highest)).append(unit));
}

void check_push(const Command& command, const Scenario& scenario, const World& world) {
  if (command.grain < 0 || command.grain >= world.grains.free_count)
    refuse(command, "grain " + std::to_string(command.grain),
           "a free grain, 0 ... " + std::to_string(world.grains.free_count - 1));
  const double limit = fastest_push * std::sqrt(world.gravity * scenario.grains.mean_diameter);
  const double speed = std::sqrt(command.x * command.x + command.y * command.y);
  if (!(speed < limit))
    refuse(command, "speed " + short_text(speed) + " m/s",
           "less than 100 sqrt(g D) = " + short_text(limit) + " m/s");
}

void check_drop(const Command& command, const Scenario& scenario, const World& world) {
  if (command.grain < 1 || command.grain > most_dropped)
    refuse(command, std::to_string(command.grain) + " grains", "1 ... " + std::to_string(most_dropped));
  if (!std::isfinite(command.x)) refuse(command, "x = " + short_text(command.x) + " m", "a place on the bed");
  if (!world.boundary.periodic) check_range(command, "x =", command.x, world.boundary.length, " m");
  check_range(command, "height", command.y, highest_drop * scenario.grains.mean_diameter, " m");
}

}  // namespace

std::string_view name_of(CommandKind kind) { return names.at(static_cast<std::size_t>(kind)); }

std::string command_text(const Command& command) {
  const std::string x = short_text(command.x), y = short_text(command.y);
  const std::string grain = std::to_string(command.grain);
  switch (command.kind) {
    case CommandKind::push:
      return "push grain " + grain + " by (" + x + ", " + y + ") m/s";
    case CommandKind::drop:
      return "drop " + grain + " grains at x = " + x + " m from " + y + " m above the surface";
    case CommandKind::friction:
      return "friction " + x;
    case CommandKind::tilt_rate:
      break;
  }
  return command.x == 0.0 ? "hold the tilt" : "tilt rate " + x + " deg/s";
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
  }
}

}  // namespace talus
