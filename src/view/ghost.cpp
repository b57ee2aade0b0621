#include "view/ghost.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <optional>

#include "core/statistics.h"

namespace talus::view {
namespace {

/// Curve of one run, in ascending x.
struct RunCurve {
  std::vector<double> x, y;
};

std::optional<std::size_t> threshold_at(const GhostRun& run, double factor) {
  for (std::size_t f = 0; f < run.factors.size(); ++f)
    if (std::abs(run.factors[f] - factor) <= 1e-9 * factor) return f;
  return std::nullopt;
}

RunCurve curve_of(const GhostRun& run, const analysis::Quantity& quantity, PlotAxis axis, double factor) {
  const auto f = analysis::needs_threshold(quantity) ? threshold_at(run, factor) : 0;
  if (!f || (axis == PlotAxis::time && run.times.empty())) return {};
  RunCurve curve;
  for (std::size_t k = 0; k < run.frames.size(); ++k) {
    const double time = axis == PlotAxis::time ? run.times[k] : 0.0;
    const double x = place_on({axis, run.theta_c}, run.frames[k].tilt, time);
    if (!std::isfinite(x)) return {};
    curve.x.push_back(x);
    curve.y.push_back(
        analysis::shown(quantity, analysis::number_of(quantity, run.frames[k], *f), run.mean_diameter));
  }
  if (!curve.x.empty() && curve.x.front() > curve.x.back()) {
    std::ranges::reverse(curve.x);
    std::ranges::reverse(curve.y);
  }
  return curve;
}

/// Interpolates between the two points around x; NaN outside the curve.
double value_at(const RunCurve& curve, double x) {
  const auto above = std::ranges::lower_bound(curve.x, x);
  if (above == curve.x.end()) return not_known;
  const auto k = static_cast<std::size_t>(above - curve.x.begin());
  if (*above == x) return curve.y[k];
  if (k == 0) return not_known;
  const double share = (x - curve.x[k - 1]) / (curve.x[k] - curve.x[k - 1]);
  return curve.y[k - 1] + share * (curve.y[k] - curve.y[k - 1]);
}

/// Returns the smallest mean spacing of points among the curves, which is that of their frames.
double spacing_of(const std::vector<RunCurve>& curves) {
  double spacing = not_known;
  for (const RunCurve& curve : curves)
    if (curve.x.size() > 1)
      spacing =
          std::fmin(spacing, (curve.x.back() - curve.x.front()) / static_cast<double>(curve.x.size() - 1));
  return spacing;
}

GhostCurve band_of(const std::vector<RunCurve>& curves) {
  GhostCurve band;
  const double spacing = spacing_of(curves);
  if (!(spacing > 0.0)) return band;
  double low = curves[0].x.front(), high = curves[0].x.back();
  for (const RunCurve& curve : curves) {
    low = std::min(low, curve.x.front());
    high = std::max(high, curve.x.back());
  }
  std::vector<double> values(curves.size());
  for (double step = std::ceil(low / spacing); step * spacing <= high; step += 1.0) {
    for (std::size_t r = 0; r < curves.size(); ++r) values[r] = value_at(curves[r], step * spacing);
    const Statistics statistics = talus::statistics_of(values);
    const bool enough = statistics.count >= 2 && 2 * statistics.count >= static_cast<int>(curves.size());
    band.x.push_back(step * spacing);
    band.mean.push_back(enough ? statistics.mean : not_known);
    band.deviation.push_back(enough ? statistics.deviation : not_known);
  }
  return band;
}

}  // namespace

std::string text_of(const Ghost& ghost) {
  if (ghost.runs.size() == 1) return ghost.name;
  return fmt::format("{}: {} runs, mean ± standard deviation", ghost.name, ghost.runs.size());
}

GhostCurve ghost_curve(const Ghost& ghost, const analysis::Quantity& quantity, PlotAxis axis, double factor) {
  std::vector<RunCurve> curves;
  for (const GhostRun& run : ghost.runs)
    if (RunCurve curve = curve_of(run, quantity, axis, factor); !curve.x.empty())
      curves.push_back(std::move(curve));
  if (curves.empty()) return {};
  if (curves.size() > 1) return band_of(curves);
  return {curves[0].x, curves[0].y, std::vector<double>(curves[0].x.size(), not_known)};
}

void plot_ghost(const Ghost* ghost, PlotAxis axis, double factor, std::vector<Plot>& plots) {
  for (Plot& plot : plots)
    for (PlotSeries& series : plot.series) {
      if (!plot.along_run || !series.quantity) continue;
      series.behind = ghost ? ghost_curve(*ghost, *series.quantity, axis, factor) : GhostCurve{};
    }
}

}  // namespace talus::view
