#include "runs/analysis_input.h"

#include <cmath>
#include <utility>

#include "analysis/frame_analysis.h"
#include "analysis/free_grains.h"
#include "core/tensor.h"
#include "core/trigonometry.h"
#include "stress/stress_state.h"

namespace talus::runs {
namespace {

/// Tolerance for the tilts of frames in a window; a tilt is a multiple of a step up to rounding.
constexpr double rounding = 1e-9;  // rad

void average_moments(const io::RunFile& run, double half_window, std::size_t k, Frame& frame) {
  const std::vector<double>& tilts = run.frame_tilts();
  const auto is_near = [&](std::size_t other) {
    return std::fabs(tilts[other] - tilts[k]) <= half_window + rounding;
  };
  std::size_t first = k, last = k;
  while (first > 0 && is_near(first - 1)) --first;
  while (last + 1 < tilts.size() && is_near(last + 1)) ++last;
  if (first == last) return;
  std::vector<Tensor2> sums(frame.internal_moment.size());
  for (std::size_t other = first; other <= last; ++other) {
    const std::vector<Tensor2> moments =
        other == k ? frame.internal_moment : run.frame(other).internal_moment;
    for (std::size_t i = 0; i < sums.size(); ++i) analysis::add_to(sums[i], moments[i]);
  }
  const double share = 1.0 / static_cast<double>(last - first + 1);
  for (std::size_t i = 0; i < sums.size(); ++i) {
    frame.internal_moment[i] = tensor(share * matrix(sums[i]));
    frame.gamma[i] = stress::stress_state(frame.internal_moment[i]).ratio;
  }
}

}  // namespace

Frame analysed_frame(const io::RunFile& run, const analysis::AnalysisParameters& parameters, std::size_t k,
                     Frame frame) {
  if (parameters.averaging > 0.0 && k < run.frame_count())
    average_moments(run, 0.5 * radians(parameters.averaging), k, frame);
  return analysis::with_analysed_gamma(std::move(frame), run.header().statics, parameters);
}

Frame analysed_frame(const io::RunFile& run, const analysis::AnalysisParameters& parameters, std::size_t k) {
  return analysed_frame(run, parameters, k, run.frame(k));
}

}  // namespace talus::runs
