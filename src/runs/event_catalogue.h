#pragma once
/// The rearrangements of a run: their times from its steps, their magnitudes from its rows of observables,
/// and the displaced grains from its frames.

#include <vector>

#include "analysis/parameters.h"
#include "analysis/record.h"
#include "io/run_file.h"

namespace talus::runs {

/// Velocity error of the solver at a residual eta, over eta g h, in the bed of the paper
/// (docs/studies/solver-trials.md).
inline constexpr double solver_velocity_error = 3000.0;
/// Default threshold of events over this velocity error.
inline constexpr double event_threshold_factor = 10.0;

/// Finds the events of a run and sets all members of the analysis named event..., as defined in the table of
/// quantities. `rows` are those of the tilt; theta_c, the tilt and the fields of frames must be set. The
/// members remain NaN if the run has no steps or rows of the tilt, as a repaired run may. Throws as
/// RunFile::positions does.
void find_events(const io::RunFile& run, const std::vector<ObservableRow>& rows,
                 const analysis::AnalysisParameters& parameters, analysis::Analysis& analysis);

/// Fits the laws of sizes and waiting angles, and computes the share of dilating events, from the events
/// found. `size_minimum`: J/m, NaN for the best fit.
void find_event_laws(double size_minimum, analysis::Analysis& analysis);

/// Returns the mean mass of a free grain, kg per metre of thickness.
double mean_grain_mass(const RunStatics& statics);

}  // namespace talus::runs
