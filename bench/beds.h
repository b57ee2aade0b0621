#pragma once
/// The beds that are measured: the paper's, narrower ones made as it was, and wider ones tiled from them.

#include "session/session.h"

namespace talus::bench {

/// How far a bed has been tilted, at 0.001 deg a step, since it came to rest. At ten degrees it is about to
/// take the next step: its tilt is that of the step, its forces are those of the step before.
enum class Slope { flat, ten_degrees };

/// The periodic bed of `grains` grains, seed 1, SI units.
///   500      L = 25 D, H = 20 D
///   2000     L = 50 D, H = 40 D
///   4000     L = 100 D, H = 40 D
///   8000     L = 200 D, H = 40 D: the paper's bed
/// and k * 4000 of H = 40 D for any other k: copies of the third side by side, which is in equilibrium as
/// that is. The first four come from a real deposition and tilt, kept as run files in the build folder.
/// `h` is the time step (s) of the rest at ten degrees: gaps and forces are those that it leaves.
/// Throws Error(usage) for other sizes.
World bed(Index grains, Slope slope, double h);

/// The flat bed of 500, 2000, 4000 or 8000 grains, about to take the first step of its tilt.
session::Session session_at_tilt(Index grains);

}  // namespace talus::bench
