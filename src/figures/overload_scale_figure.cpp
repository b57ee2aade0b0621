#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "analysis/overload/coarse_graining.h"
#include "core/statistics.h"
#include "figures/failed_group.h"
#include "figures/recipes.h"
#include "figures/run_means.h"
#include "runs/analysis_input.h"
#include "runs/analysis_parameters.h"

namespace talus::figures {
namespace {

const FrameWords frames_compared = {"0", "15", "repose"};

/// Returns diameters up to `largest`, in D: 0 for the single grain, then from the first neighbours upwards.
std::vector<double> scales_up_to(double largest) {
  std::vector<double> scales;
  for (const double l :
       {0.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 12.0, 14.0, 16.0, 18.0, 20.0})
    if (l <= largest) scales.push_back(l);
  return scales;
}

/// Returns p_o of a frame at each diameter (D), with the printed threshold.
std::vector<double> shares_of(const runs::RunView& run, std::size_t k, std::vector<double> scales) {
  const RunStatics& statics = run.file->header().statics;
  analysis::AnalysisParameters parameters = runs::from_facts(run.analysis.parameters);
  parameters.l_min = 0.0;
  for (double& l : scales) l *= statics.mean_diameter;
  return analysis::overloaded_over_scale({runs::analysed_frame(*run.file, parameters, k), statics},
                                         run.analysis.gamma_c, scales);
}

/// Returns the mean over the runs, at one frame of each, and its error; NaN if fewer than half of `all`
/// remain.
std::vector<Column> mean_shares(const FramesAtAngle& at, std::size_t all, const std::vector<double>& scales,
                                Column mean) {
  Column error{mean.name + "_error", mean.unit, "its standard error over the runs", {}};
  const bool enough = 2 * at.runs.size() >= all;
  std::vector<std::vector<double>> shares;
  for (std::size_t r = 0; r < at.runs.size() && enough; ++r)
    shares.push_back(shares_of(*at.runs[r], at.frames[r], scales));
  for (std::size_t s = 0; s < scales.size(); ++s) {
    std::vector<double> each;
    for (const std::vector<double>& of_run : shares) each.push_back(of_run[s]);
    const Statistics result = statistics_of(each);
    mean.values.push_back(result.mean);
    error.values.push_back(result.error);
  }
  return {std::move(mean), std::move(error)};
}

std::vector<Column> scale_columns(const RunChoice& runs, std::span<const ShownFrames> shown) {
  const RunStatics& statics = runs.front()->file->header().statics;
  const std::vector<double> scales = scales_up_to(analysis::length_cut(statics, 0.0) / statics.mean_diameter);
  std::vector<Column> columns = {{"l", "D", "diameter of the neighbourhood; 0: the single grain", scales}};
  for (const ShownFrames& frames : shown)
    for (Column& column :
         mean_shares(frames.at, runs.size(), scales,
                     {"p_o_" + frames.name,
                      "1",
                      fmt::format("share of the grains that carry something with gamma_l >= Gamma_c {}, {}",
                                  frames.text, runs_text(frames.at.runs.size())),
                      {}}))
      columns.push_back(std::move(column));
  return columns;
}

}  // namespace

std::optional<Figure> overload_scale_figure(std::span<const RunGroup> groups, const FrameWords& at) {
  Figure figure;
  std::vector<ShownFrames> shown;
  figure.name = "overloaded-over-scale";
  figure.title = "Overloaded fraction over the size of neighbourhoods";
  figure.caption =
      "Fraction p_o of the grains whose neighbourhood of diameter l has a stress ratio gamma_l of at least "
      "Gamma_c = sin(theta_c), over l, among the grains that carry something: the single grain at l = 0, "
      "with its first neighbours from about 2 D; periodic beds. Dashed line: the paper's p_o at theta_c, "
      "0.60. Means over the failed runs of a bed, at angles that at least half of them reach; error bars are "
      "standard errors over the runs, none for a single run.";
  for (const RunGroup& group : groups) {
    const RunChoice runs = with_frames(failed_runs(group));
    if (!group.periodic() || runs.empty()) continue;
    shown = shown_frames(runs, at, frames_compared);
    add_group_table(figure, group, runs, scale_columns(runs, shown));
  }
  if (figure.tables.empty()) return std::nullopt;
  set_shown_frames(figure, shown);
  figure.height_over_width = 0.7 * static_cast<double>(figure.groups);
  return figure;
}

}  // namespace talus::figures
