#pragma once
/// Commands that a user gives during a run. Replaying a scenario and its commands gives the same bits.

#include <array>
#include <cstdint>
#include <string_view>

#include "core/types.h"

namespace talus {

enum class CommandKind : std::int8_t {
  push = 0,       ///< adds (x, y), m/s, to the velocity of the free grain `grain`
  drop = 1,       ///< lifts a number `grain` of grains from the free surface, those farthest from x (m) along
                  ///< the bed, and lets them fall at x from y (m) above the free surface there
  friction = 2,   ///< sets the friction between grains, and between grains and floor, to x
  tilt_rate = 3,  ///< sets the rate of the tilt to x, deg/s (< 0: down); the time step stays
  drag = 4,       ///< attaches a spring that pulls the centre of the free grain `grain` to (x, y), m
  release = 5,    ///< ends the drag
};
inline constexpr std::int8_t command_kind_count = 6;
inline constexpr std::array<std::string_view, command_kind_count> command_kind_names = {
    "push", "drop", "friction", "tilt_rate", "drag", "release"};

struct Command {
  std::int64_t step = 0;  ///< number of steps before the command; it acts from the next step on
  CommandKind kind = CommandKind::push;
  Index grain = -1;
  double x = 0.0, y = 0.0;

  bool operator==(const Command&) const = default;
};

// The spring with which a user drags a grain.

/// Stiffness of the spring, m g / D, m being the mass of the grain: extended by n D, it pulls with 10 n m g.
inline constexpr double drag_stiffness = 10.0;
/// Largest extension of the spring, D.
inline constexpr double farthest_drag = 50.0;

}  // namespace talus
