#pragma once
/// The rearrangements of a run: their times from its steps, their magnitudes from its rows of observables,
/// and the displaced grains from its frames; and the first grains that move by a given distance.

#include <cstddef>
#include <vector>

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

/// A free grain in the first frame in which its displacement since the first frame of the run, at the start
/// of the tilt, reaches a given distance. Displacements are relative to the bed and do not include its
/// rotation.
struct FirstMove {
  Index grain = 0;
  std::size_t frame = 0;      ///< number of the frame, counted from 0
  double time = 0.0;          ///< time of the frame, s
  double tilt = 0.0;          ///< rad
  double x = 0.0, y = 0.0;    ///< centre of the grain in this frame, m
  double depth = 0.0;         ///< depth below the mean free surface, V / L, of this frame, m
  double displacement = 0.0;  ///< m
};

/// Returns the first move of each grain that moves by `distance` (m), by frame, and within a frame in
/// descending order of displacement. The flow after failure is included. Motion that reverses within the
/// interval between two frames is not detected. Throws as RunFile::positions does.
std::vector<FirstMove> first_moves(const io::RunFile& run, double distance);

}  // namespace talus::runs
