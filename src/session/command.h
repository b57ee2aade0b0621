#pragma once
/// Commands: their names, checks, and effects on a world.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/command.h"
#include "core/observables.h"
#include "core/world.h"
#include "scenario/scenario.h"
#include "session/schedule.h"

namespace talus::session {

using scenario::Scenario;

/// Returns "push", "drop", "friction", "tilt_rate", "drag" or "release".
std::string_view name_of(CommandKind kind);

/// Returns a description such as "push grain 12 by (0.1, 0) m/s".
std::string command_text(const Command& command);

/// Throws Error(usage) if a command cannot be applied to this bed (scenario::command_fault); a drag must be
/// held within 50 D of its grain.
void check_command(const Command& command, const Scenario& scenario, const World& world);

/// Returns the commands as given: only the start of each drag, without its moves and its end.
std::vector<Command> given_commands(std::span<const Command> commands);

/// Returns the rows of a run, extended by the state after its last step, so that later commands can be
/// placed; the added row has only step, time (s) and tilt (rad).
std::vector<ObservableRow> rows_up_to(std::span<const ObservableRow> rows, std::int64_t step, double time,
                                      double tilt);

/// Returns the tilt (rad) of the bed when a command was given, to rounding. Between successive `rows`
/// (rows_up_to) the tilt is linear in the steps, apart from those of `commands` (all of the run) that set its
/// rate. NaN before the first row, during the deposition.
double tilt_before(const Command& command, std::span<const Command> commands,
                   std::span<const ObservableRow> rows);
/// Returns the time (s) at which a command was given; NaN as in tilt_before.
double time_before(const Command& command, std::span<const ObservableRow> rows);

/// Returns the free grains at the free surface, ascending: those with nothing above their centres.
std::vector<Index> surface_grains(const World& world);

/// Lifts `count` grains from the free surface, those farthest from x (m; distances are periodic in a periodic
/// bed), and places them in a square lattice about x, at rest, `height` (m) above the highest grain below it.
/// They touch nothing, and their contacts are removed. Throws Error(usage) if the surface has fewer grains.
void drop_grains(World& world, Index count, double x, double height);

// Drag of a grain by a user with a damped spring.

/// Returns the acceleration (m/s^2) that the spring adds to gravity at the centre of its grain, w^2 d - 2 w
/// v, with the vector d and the velocity v of the grain, which is critical damping. w^2 = 10 g / D, but w h
/// is limited to a quarter, because the force is constant within a step (T4), which is unstable or weakly
/// damped for larger w h.
Vec2 drag_acceleration(const Drag& drag, double mean_diameter, double h, const World& world);

/// Adds the velocity that the spring gives the grain in a step of length h, before the step is taken.
void pull(const Drag& drag, double mean_diameter, double h, World& world);

}  // namespace talus::session
