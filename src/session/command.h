#pragma once
/// Commands: how they are called, what they may say, and what they do to a world.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/command.h"
#include "core/world.h"
#include "scenario/scenario.h"

namespace talus {

/// The largest coefficient of friction that a command can set.
inline constexpr double largest_friction = 10.0;

/// "push", "drop", "friction", "tilt_rate", "drag", "release".
std::string_view name_of(CommandKind kind);

/// What a command does, for a reader: "push grain 12 by (0.1, 0) m/s".
std::string command_text(const Command& command);

/// Throws Error(usage) where a command says what cannot be done to this bed: no such grain, a value that is
/// not finite or out of range. Speeds are below 100 sqrt(g D), counts 1 ... 1000, heights 0 ... 100 D,
/// frictions 0 ... 10, rates 0 (the tilt is held) ... 100 deg/s, and a drag is held within 50 D of its grain;
/// between walls x of a drop lies on the bed.
void check_command(const Command& command, const Scenario& scenario, const World& world);

/// The commands that somebody gave: of each drag only its beginning, without what moved and ended it.
std::vector<Command> given_commands(std::span<const Command> commands);

/// The free grains at the free surface, ascending: those with nothing above their centres.
std::vector<Index> surface_grains(const World& world, double mean_diameter);

/// Lifts `count` grains at the free surface, those farthest from x (m; a periodic bed goes on across its
/// edge), and places them in a square lattice about x, at rest, `height` (m) above the highest grain below
/// it. They touch nothing, and the contacts they had are gone. Throws Error(usage) where the surface has
/// fewer grains.
void drop_grains(World& world, Index count, double x, double height, double mean_diameter);

}  // namespace talus
