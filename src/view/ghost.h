#pragma once
/// What stands behind the curves of a run: another run, or an ensemble.

#include <string>
#include <vector>

#include "analysis/record.h"
#include "core/snapshot.h"
#include "view/plots.h"

namespace talus::view {

/// A run behind the curves: the part of it that leads to failure.
struct GhostRun {
  std::vector<analysis::FrameRecord> frames;  ///< of its last rise, with all thresholds of its analysis
  std::vector<double> times;                  ///< of these frames, s; empty where they are not known
  std::vector<double> factors;                ///< of the thresholds, in Gamma_c
  double theta_c = not_known;                 ///< rad
  double mean_diameter = 0.0;                 ///< m
};

struct Ghost {
  std::string name;  ///< of the file
  std::vector<GhostRun> runs;
};

/// "other.h5", "beds: 50 runs, mean ± standard deviation".
std::string text_of(const Ghost& ghost);

/// A quantity of the ghost over an axis of plots, each run with its own theta_c and D, as shown (deg, s, D,
/// %); one with a threshold at `factor` Gamma_c of each run. Of a single run these are its frames. Of
/// several it is their mean and standard deviation (n - 1) on a common grid, interpolated linearly between
/// the frames of each, where at least half of them, and two, have a value. Empty where no run has the axis or
/// the threshold.
GhostCurve ghost_curve(const Ghost& ghost, const analysis::Quantity& quantity, PlotAxis axis, double factor);

/// Puts it behind all curves along the run that show a quantity; without a ghost takes it away.
void plot_ghost(const Ghost* ghost, PlotAxis axis, double factor, std::vector<Plot>& plots);

}  // namespace talus::view
