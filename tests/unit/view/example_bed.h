#pragma once
/// Hand-made bed: ten columns of four grains on floor grains, mean diameter 1 m, periodic. Each grain carries
/// the same load along and across the bed (gamma = 0), except the lowest `overloaded` grains of column 0,
/// which carry load only along the bed (gamma = 1).

#include <string>
#include <vector>

#include "core/snapshot.h"
#include "io/run_store.h"

namespace talus::example {

inline constexpr Index columns = 10, rows = 4;

RunStatics bed_statics();
/// Returns the bed at `tilt` (deg). Each grain touches the one below it; its index is row * columns + column.
Frame bed_frame(double tilt, Index overloaded);

/// Writes a run with these frames, and with a row of observables and a step every 0.5 deg up to 25; step k of
/// these took k iterations, and 7, 17, ... have not converged. `theta_c` in deg; NaN: the slope has not
/// failed.
void write_run(const std::string& path, double theta_c, std::vector<Frame> frames);

/// Number of overloaded grains in the frames of bed_run, at 0, 5, 10, 15, 20, 25 deg; the cluster spans from
/// the fourth on.
inline const std::vector<Index> overloaded_of_frames = {0, 1, 2, 4, 4, 4};
/// Writes the run of these frames, with grain 39 raised by 1 m in the third, and with two frames of a flow,
/// at 24 and 23 deg.
void write_bed_run(const std::string& path, double theta_c);

}  // namespace talus::example
