#pragma once
/// Where a grain comes to rest that falls and rolls over others under gravity alone, without inertia
/// (Visscher and Bolsterli 1972, Nature 239, 504).

#include "dynamics/disc_grid.h"

namespace talus::dynamics {

/// A grain that is set down.
struct FallingGrain {
  double x = 0.0;       ///< m, the line along which it falls
  double radius = 0.0;  ///< m
  /// Sine of the largest angle between the contact normal and the vertical at which a grain stays on the
  /// grain it has fallen on (Bratberg, Radjai and Hansen 2002); 0: it always rolls.
  double critical_sine = 0.0;
};

/// Where its centre comes to rest, m; x in [0, length) of a periodic bed. The grain falls until it touches,
/// rolls down over what it touches until something on the other side holds it, from one grain to the next,
/// and falls again where it has rolled down to the equator of a grain. It overlaps with nothing, to
/// round-off. The bed has a floor without holes. Throws Error(internal) where the way has no end.
Vec2 resting_place(const DiscGrid& bed, const FallingGrain& grain);

}  // namespace talus::dynamics
