#pragma once
/// The rearrangements of a run: from its steps when, from its rows of observables by how much, from its
/// frames what moved.

#include <vector>

#include "analysis/parameters.h"
#include "analysis/record.h"
#include "io/run_file.h"

namespace talus::runs {

/// Velocity that the solver leaves at a residual eta, over eta g h, in the paper's bed (docs/solver.md).
inline constexpr double solver_velocity_error = 3000.0;
/// How far above it the threshold of events lies where none is given.
inline constexpr double event_threshold_factor = 10.0;

/// Where the slope failed, the tilt and the fields of frames are known already. `rows` are those of the
/// tilt. Sets all members of the analysis that are called event..., as the table of quantities defines
/// them. Nothing but their NaN where the run has no steps or rows of the tilt, as one that was repaired may.
/// Throws as RunFile::positions does.
void find_events(const io::RunFile& run, const std::vector<ObservableRow>& rows,
                 const analysis::AnalysisParameters& parameters, analysis::Analysis& analysis);

/// The laws of sizes and waiting angles, and the share that dilates, of the events that are there.
/// `size_minimum`: J/m, NaN for that of the best fit.
void find_event_laws(double size_minimum, analysis::Analysis& analysis);

/// Mean mass of a free grain, kg/m.
double mean_grain_mass(const RunStatics& statics);

}  // namespace talus::runs
