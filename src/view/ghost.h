#pragma once
/// Reference curves drawn behind those of a run: another run, or an ensemble.

#include <string>
#include <vector>

#include "analysis/record.h"
#include "core/snapshot.h"
#include "view/plots.h"

namespace talus::view {

/// One reference run: the part of it that leads to failure.
struct GhostRun {
  std::vector<analysis::FrameRecord>
      frames;                   ///< frames of its last rise, with all thresholds of its analysis
  std::vector<double> times;    ///< times of these frames, s; empty if unknown
  std::vector<double> factors;  ///< factors of the thresholds, in Gamma_c
  double theta_c = not_known;   ///< rad
  double mean_diameter = 0.0;   ///< m
};

struct Ghost {
  std::string name;  ///< name of the file
  std::vector<GhostRun> runs;
};

/// Returns "other.h5", or "beds: 50 runs, mean ± standard deviation".
std::string text_of(const Ghost& ghost);

/// Returns a quantity of the ghost over an axis of plots, in the displayed units (deg, s, D, %), each run
/// with its own theta_c and D; a quantity with a threshold is taken at `factor` Gamma_c of each run. For a
/// single run the points are its frames. For several runs they are the mean and the standard deviation (n -
/// 1) on a common grid, interpolated linearly between the frames of each run, wherever at least half of the
/// runs, and at least two, have a value. Empty if no run has the axis or the threshold.
GhostCurve ghost_curve(const Ghost& ghost, const analysis::Quantity& quantity, PlotAxis axis, double factor);

/// Draws the ghost behind all curves along the run that show a quantity; a null ghost removes it.
void plot_ghost(const Ghost* ghost, PlotAxis axis, double factor, std::vector<Plot>& plots);

}  // namespace talus::view
