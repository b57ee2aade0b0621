#pragma once
/// A bed made by hand: ten columns of four grains on floor grains, mean diameter 1 m, periodic. Each grain
/// carries the same along the bed and across it (gamma = 0), but the lowest `overloaded` of column 0, which
/// carry along the bed only (gamma = 1).

#include <string>
#include <vector>

#include "core/snapshot.h"
#include "io/run_store.h"

namespace talus::example {

inline constexpr Index columns = 10, rows = 4;

RunStatics bed_statics();
/// `tilt` in deg. Each grain touches the one below it; grain row * columns + column.
Frame bed_frame(double tilt, Index overloaded);

/// A run of these frames, with a row of observables every 0.5 deg up to 25. `theta_c` in deg; NaN: the slope
/// has not failed.
void write_run(const std::string& path, double theta_c, std::vector<Frame> frames);

/// How many are overloaded in the frames of bed_run, at 0, 5, 10, 15, 20, 25 deg; the bed spans from the
/// fourth on.
inline const std::vector<Index> overloaded_of_frames = {0, 1, 2, 4, 4, 4};
/// The run of these, in the third of which grain 39 lies a metre higher, and two more frames of a flow, at 24
/// and 23 deg.
void write_bed_run(const std::string& path, double theta_c);

}  // namespace talus::example
