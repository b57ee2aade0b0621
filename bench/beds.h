#pragma once
/// Beds for the benchmarks: the paper's, narrower ones deposited in the same way, and wider ones tiled from
/// these.

#include "session/session.h"

namespace talus::bench {

/// Tilt of a bed: flat as it came to rest, or ten degrees, reached in steps of 0.001 deg. At ten degrees the
/// bed is about to take the next step: its tilt is that of the step, its forces are those of the previous
/// step.
enum class Slope { flat, ten_degrees };

/// Returns the periodic bed of `grains` grains, seed 1, SI units.
///   500      L = 25 D, H = 20 D
///   2000     L = 50 D, H = 40 D
///   4000     L = 100 D, H = 40 D
///   8000     L = 200 D, H = 40 D: the paper's bed
/// and k * 4000 of H = 40 D for any other k: copies of the third in a row, which are in equilibrium like
/// the original. The first four are deposited and tilted, and kept as run files in the build folder.
/// `h` is the time step (s) with which the bed comes to rest at ten degrees, which determines gaps and
/// forces. Throws Error(usage) for other sizes.
World bed(Index grains, Slope slope, double h);

/// Returns the flat bed of 500, 2000, 4000 or 8000 grains, before the first step of its tilt.
session::Session session_at_tilt(Index grains);

}  // namespace talus::bench
