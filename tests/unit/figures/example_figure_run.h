#pragma once
/// Runs of figures with hand-made analyses, on the frames of one small run.

#include <cmath>
#include <string>

#include "core/trigonometry.h"
#include "figures/run_group.h"
#include "unit/io/example_run.h"

namespace talus::example {

/// Opens the run at `path` (three frames) as one that fails at theta_c, deg; NaN: not at all, and without
/// thresholds.
inline FigureRun figure_run(const std::string& path, std::uint64_t seed, double theta_c = std::nan("")) {
  FigureRun run{path, RunFile::open(path), {}, {}};
  run.scenario.seed = seed;
  const std::uint64_t thresholds = std::isnan(theta_c) ? 0 : 2;
  run.analysis =
      make_analysis({{'T', run.file.frame_count()}, {'N', 1}, {'F', thresholds}, {'X', 2}, {'B', 2}});
  values<double>(run.analysis, "theta_c")[0] = radians(theta_c);
  if (thresholds > 0) {
    values<double>(run.analysis, "threshold_factor")[0] = 1.0;
    values<double>(run.analysis, "threshold_factor")[1] = 2.0;
    values<double>(run.analysis, "gamma_c")[0] = sine(radians(theta_c));
  }
  return run;
}

}  // namespace talus::example
