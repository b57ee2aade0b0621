#pragma once
/// Runs with hand-made analyses for figures, based on the frames of one small run.

#include <cmath>
#include <string>

#include "core/trigonometry.h"
#include "figures/run_group.h"
#include "support/blank_analysis.h"
#include "unit/io/example_run.h"

namespace talus::example {

/// Opens the run at `path` (three frames) as a run that fails at theta_c, deg; with NaN it does not fail and
/// has no thresholds.
inline runs::RunView figure_run(const std::string& path, std::uint64_t seed, double theta_c = std::nan("")) {
  runs::RunView run = runs::view_of_run(path, io::RunFile::open(path), {});
  run.scenario.seed = seed;
  const std::uint64_t thresholds = std::isnan(theta_c) ? 0 : 2;
  run.analysis = test::blank_analysis(
      {.frames = run.file->frame_count(), .thresholds = thresholds, .sections = 2, .bins = 2});
  for (std::size_t k = 0; k < run.file->frame_count(); ++k)
    run.analysis.frames[k].tilt = run.file->frame_tilts()[k];
  run.analysis.theta_c = radians(theta_c);
  if (thresholds > 0) {
    run.analysis.thresholds[0].factor = 1.0;
    run.analysis.thresholds[1].factor = 2.0;
    run.analysis.gamma_c = sine(radians(theta_c));
  }
  return run;
}

}  // namespace talus::example
