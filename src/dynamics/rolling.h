#pragma once
/// The position of rest of a grain that falls and rolls over others under gravity, without inertia (Visscher
/// and Bolsterli 1972, Nature 239, 504).

#include "dynamics/disc_grid.h"

namespace talus::dynamics {

/// A grain to be placed on a bed.
struct FallingGrain {
  double x = 0.0;       ///< m, position of the line along which it falls
  double radius = 0.0;  ///< m
  /// Sine of the largest angle between contact normal and vertical at which the grain stays where it has
  /// landed on another one (Bratberg, Radjai and Hansen 2002); 0: it always rolls.
  double critical_sine = 0.0;
};

/// Returns the position of its centre at rest, m; x in [0, length) of a periodic bed. The grain falls until
/// it touches, rolls down from one grain to the next until a body on the other side holds it, and falls again
/// after it has rolled down to the equator of a grain. At rest it overlaps no body beyond round-off. The
/// floor of the bed must have no holes. Throws Error(internal) if the path does not end.
Vec2 resting_place(const DiscGrid& bed, const FallingGrain& grain);

}  // namespace talus::dynamics
