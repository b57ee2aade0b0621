#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <numeric>

#include "core/statistics.h"
#include "core/trigonometry.h"
#include "figures/failed_group.h"
#include "figures/recipes.h"
#include "figures/run_means.h"
#include "figures/wall_fit.h"

namespace talus::figures {
namespace {

constexpr double paper_k = 2.5;  // k_L - k_0 (paper, Fig. 7)

/// Returns M g / (2 L), Pa, the mean of sigma_yy in the horizontal bed at rest.
double mean_weight(const RunStatics& statics) {
  const double mass = std::accumulate(statics.mass.begin(), statics.mass.begin() + statics.free_count, 0.0);
  return mass * statics.gravity / (2.0 * statics.length);
}

/// Returns the centre of each section, in D.
Column section_column(const runs::RunView& run) {
  Column x{"x", "D", "middle of the section, from the upper wall downslope", {}};
  const std::vector<double>& edges = run.analysis.section_edge;
  for (std::size_t s = 0; s + 1 < edges.size(); ++s)
    x.values.push_back(0.5 * (edges[s] + edges[s + 1]) / run.statics.mean_diameter);
  return x;
}

/// Returns the mean and standard error over the runs of sigma_xx of each section, in frames[r] of run r.
std::vector<Column> section_stresses(const RunChoice& runs, const std::vector<std::size_t>& frames,
                                     const std::string& name) {
  Column mean{name, "M g / (2 L)", "mean sigma_xx of the section", {}};
  Column error{name + "_error", mean.unit, "its standard error over the runs", {}};
  for (std::size_t s = 0; s + 1 < runs.front()->analysis.section_edge.size(); ++s) {
    std::vector<double> stresses;
    for (std::size_t r = 0; r < runs.size(); ++r)
      stresses.push_back(runs[r]->analysis.frames.at(frames[r]).section_sigma_xx[s] /
                         mean_weight(runs[r]->file->header().statics));
    const Statistics result = statistics_of(stresses);
    mean.values.push_back(result.mean);
    error.values.push_back(result.error);
  }
  return {std::move(mean), std::move(error)};
}

/// The data of Fig. 7 for one group.
struct WallGroup {
  Statistics ratio;     ///< mean over the runs
  double spread = 0.0;  ///< rms over the runs of the standard deviation in the window
  double depth = 0.0;   ///< mean height V / L before failure, D
};

double mean_depth(const runs::RunView& run) {
  const double length = run.scenario.bed.length * run.statics.mean_diameter;
  return run.analysis.frames.at(repose_frame(run)).volume / length / run.statics.mean_diameter;
}

WallGroup wall_group(const RunChoice& runs, std::vector<WallPoint>& points) {
  WallGroup result;
  std::vector<double> ratios, squares;
  for (const runs::RunView* run : runs) {
    ratios.push_back(run->analysis.failure_ratio);
    squares.push_back(run->analysis.failure_ratio_spread * run->analysis.failure_ratio_spread);
    result.depth += mean_depth(*run) / static_cast<double>(runs.size());
    points.push_back({mean_depth(*run) / run->scenario.bed.length, run->analysis.failure_ratio});
  }
  result.ratio = statistics_of(ratios);
  result.spread = std::sqrt(statistics_of(squares).mean);
  return result;
}

Table empty_wall_table() {
  return {"",
          {{"L", "D", "length of the bed", {}},
           {"n", "1", "number of runs in the row", {}},
           {"ratio",
            "1",
            "(sigma_T / sigma_N) / tan(theta), mean over the last 0.5 deg before theta_c and over runs",
            {}},
           {"ratio_error", "1", "its standard error over the runs", {}},
           {"ratio_spread", "1", "standard deviation within these 0.5 deg, rms over the runs", {}},
           {"bar", "1", "what the error bar shows: ratio_error, or ratio_spread for a single run", {}},
           {"H", "D", "mean height V / L of the bed before failure", {}}}};
}

void add_row(Table& table, const std::vector<double>& row) {
  for (std::size_t c = 0; c < row.size(); ++c) table.columns[c].values.push_back(row[c]);
}

std::string plus_minus(const WallFit& fit) {
  return rounded_text(fit.k, 2) + (std::isnan(fit.error) ? "" : " ± " + rounded_text(fit.error, 2));
}

}  // namespace

std::optional<Figure> wall_stress_figure(std::span<const RunGroup> groups, const FrameWords& at) {
  const auto shortest = std::ranges::find_if(groups, [](const RunGroup& group) {
    // Groups are in ascending order of length.
    return !group.periodic() && !with_files(failed_runs(group)).empty();
  });
  if (shortest == groups.end()) return std::nullopt;
  const RunChoice runs = with_files(failed_runs(*shortest));
  Figure figure;
  figure.name = "fig06-wall-stress";
  figure.title = "Stress sigma_xx along a bed between walls (paper, Fig. 6)";
  figure.caption = fmt::format(
      "Normal stress sigma_xx of sections along the bed over their distance x from the upper wall, {}, in "
      "units of M g / (2 L), the mean of sigma_yy in the horizontal bed (M: mass of the grains). Means over "
      "{}, error bars: standard errors over these runs, none for a single run.",
      shortest->label, runs_text(runs.size()));
  Table table{"", {section_column(*runs.front())}};
  std::vector<ShownFrames> shown = shown_frames(runs, at, {"0", "10", "repose"});
  std::erase_if(shown, [&](const ShownFrames& frames) { return frames.at.runs.size() < runs.size(); });
  for (const ShownFrames& frames : shown)
    for (Column& column : section_stresses(runs, frames.at.frames, "sigma_xx_" + frames.name))
      table.columns.push_back(std::move(column));
  set_shown_frames(figure, shown);
  for (const runs::RunView* run : runs) figure.runs.push_back(run->path);
  set_variable(figure, "bed",
               gnuplot_quoted(fmt::format("{} ({})", shortest->label, runs_text(runs.size()))));
  set_variable(figure, "length", runs.front()->scenario.bed.length);
  figure.tables = {std::move(table)};
  return figure;
}

std::optional<Figure> wall_ratio_figure(std::span<const RunGroup> groups) {
  Figure figure;
  figure.name = "fig07-wall-ratio";
  figure.title = "Shear stress at failure over the length between walls (paper, Fig. 7)";
  Table table = empty_wall_table();
  std::vector<WallPoint> points;
  std::vector<double> depths;
  for (const RunGroup& group : groups) {
    RunChoice runs = failed_runs(group);
    // Sparse rows may leave none in the last 0.5 deg.
    std::erase_if(runs, [](const runs::RunView* run) { return std::isnan(run->analysis.failure_ratio); });
    if (group.periodic() || runs.empty()) continue;
    const WallGroup wall = wall_group(runs, points);
    depths.push_back(wall.depth);
    add_row(table,
            {runs.front()->scenario.bed.length, static_cast<double>(runs.size()), wall.ratio.mean,
             wall.ratio.error, wall.spread, runs.size() > 1 ? wall.ratio.error : wall.spread, wall.depth});
    for (const runs::RunView* run : runs) figure.runs.push_back(run->path);
  }
  if (points.empty()) return std::nullopt;
  const WallFit fit = fit_wall_law(points);
  const double depth = statistics_of(depths).mean;
  figure.caption = fmt::format(
      "(sigma_T / sigma_N) / tan(theta) of beds between walls over their length L, mean over the last 0.5 "
      "deg before theta_c and over the runs of each length ({} in total). Error bars: standard error over "
      "the runs; for a single run the standard deviation within the 0.5 deg. Lines: 1 - (k_L - k_0)/3 H/L "
      "(paper, Eq. 15), fitted to all runs by least squares, k_L - k_0 = {} (standard error), and with the "
      "paper's 2.5. H is the mean height V/L of each bed before failure, as in the paper's integral over the "
      "depth; the lines use its mean, H = {} D.",
      runs_text(points.size()), plus_minus(fit), rounded_text(depth, 1));
  set_variable(figure, "k", fit.k);
  set_variable(figure, "k_text", gnuplot_quoted(plus_minus(fit)));
  set_variable(figure, "k_paper", paper_k);
  set_variable(figure, "depth", depth);
  figure.tables = {std::move(table)};
  return figure;
}

}  // namespace talus::figures
