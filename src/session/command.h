#pragma once
/// Commands: how they are called, what they may say, and what they do to a world.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/command.h"
#include "core/observables.h"
#include "core/world.h"
#include "scenario/scenario.h"

namespace talus::session {

/// "push", "drop", "friction", "tilt_rate", "drag", "release".
std::string_view name_of(CommandKind kind);

/// What a command does, for a reader: "push grain 12 by (0.1, 0) m/s".
std::string command_text(const Command& command);

/// Throws Error(usage) where a command says what cannot be done to this bed (scenario::command_fault); a drag
/// is held within 50 D of its grain.
void check_command(const Command& command, const scenario::Scenario& scenario, const World& world);

/// The commands that somebody gave: of each drag only its beginning, without what moved and ended it.
std::vector<Command> given_commands(std::span<const Command> commands);

/// The rows of a run with the state after its last step, so that what came after the last row can be placed;
/// of such a row only step, time (s) and tilt (rad) are known.
std::vector<ObservableRow> rows_up_to(std::span<const ObservableRow> rows, std::int64_t step, double time,
                                      double tilt);

/// The tilt (rad) of the bed when a command was given, to rounding: from one of the `rows` (rows_up_to) to
/// the next the tilt is linear in the steps, but for those of `commands`, all of the run, that set its rate.
/// NaN before the first row, while the bed was being deposited.
double tilt_before(const Command& command, std::span<const Command> commands,
                   std::span<const ObservableRow> rows);
/// The time (s) at which a command was given. NaN as tilt_before.
double time_before(const Command& command, std::span<const ObservableRow> rows);

/// The free grains at the free surface, ascending: those with nothing above their centres.
std::vector<Index> surface_grains(const World& world);

/// Lifts `count` grains at the free surface, those farthest from x (m; a periodic bed goes on across its
/// edge), and places them in a square lattice about x, at rest, `height` (m) above the highest grain below
/// it. They touch nothing, and the contacts they had are gone. Throws Error(usage) where the surface has
/// fewer grains.
void drop_grains(World& world, Index count, double x, double height);

}  // namespace talus::session
