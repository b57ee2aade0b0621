#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <numeric>
#include <string>

#include "analysis/cells.h"
#include "analysis/free_grains.h"
#include "analysis/overload/coarse_graining.h"
#include "base/text.h"
#include "core/trigonometry.h"
#include "figures/failed_group.h"
#include "figures/recipes.h"
#include "figures/run_means.h"
#include "pictures/maps.h"
#include "runs/analysis_input.h"
#include "runs/analysis_parameters.h"

namespace talus::figures {
namespace {

constexpr double paper_tilt = 10.0;  // deg

/// The grain and frame that are drawn.
struct GrainChoice {
  std::size_t k = 0;
  Frame frame;
  Index grain = 0;
};

/// Returns the typical grain of the frame nearest to this tilt (rad) that has one, up to the last frame
/// before theta_c. In a small bed some frames have none.
std::optional<GrainChoice> shown_grain(const runs::RunView& run, double tilt) {
  const RunStatics& statics = run.file->header().statics;
  std::vector<std::size_t> nearest(repose_frame(run) + 1);
  std::iota(nearest.begin(), nearest.end(), std::size_t{0});
  std::ranges::stable_sort(
      nearest, {}, [&run, tilt](std::size_t k) { return std::abs(run.analysis.frames.at(k).tilt - tilt); });
  for (const std::size_t k : nearest) {
    Frame frame = runs::analysed_frame(*run.file, runs::from_facts(run.analysis.parameters), k);
    const auto grain = typical_grain({frame, statics}, run.analysis.frames.at(k).thresholds);
    if (grain) return GrainChoice{k, std::move(frame), *grain};
  }
  return std::nullopt;
}

bool in_middle_half(double value, double end) { return value >= 0.25 * end && value <= 0.75 * end; }

/// Returns the diameter of the largest neighbourhood shown, in D: an even number well above l_c.
double largest_shown(double largest_l_c, double cut) {
  return std::min(std::max(8.0, 2.0 * std::ceil(largest_l_c)), cut);
}

Table curve_table(const analysis::NeighbourhoodCurve& curve, double diameter) {
  Table table{"",
              {{"l", "D", "diameter of the neighbourhood", {}},
               {"gamma_l", "1", "stress ratio of the summed internal moments of its grains", curve.gamma}}};
  for (const double l : curve.l) table.columns[0].values.push_back(l / diameter);
  return table;
}

std::vector<double> all_of(double analysis::RunThreshold::*member, const analysis::Analysis& analysis) {
  std::vector<double> values;
  for (const analysis::RunThreshold& threshold : analysis.thresholds) values.push_back(threshold.*member);
  return values;
}

Table length_table(const analysis::Analysis& analysis, std::span<const double> lengths) {
  return {"l_c",
          {{"factor", "1", "threshold over Gamma_c", all_of(&analysis::RunThreshold::factor, analysis)},
           {"threshold", "1", "threshold", all_of(&analysis::RunThreshold::gamma, analysis)},
           {"l_c", "D", "smallest l with gamma_l <= threshold", {lengths.begin(), lengths.end()}}}};
}

/// Returns numbers separated by blanks as a gnuplot text.
std::string word_list(std::span<const double> numbers) {
  return gnuplot_quoted(joined(numbers, " ", [](double number) { return rounded_text(number, 6); }));
}

std::string caption_of(const FailedGroup& failed, const Frame& frame, Index grain) {
  return fmt::format(
      "(a) Grain {} of {} at theta = {} deg, outlined, and the surrounding grains in the gray of their "
      "gamma, white below {} and black from 2 Gamma_c upwards. A neighbourhood of diameter l contains all "
      "grains whose centres lie within the circle: thin circles every 2 D, thick ones at l_c. (b) Stress "
      "ratio gamma_l of the neighbourhood over l; l_c is the smallest l, starting from that of gamma, at "
      "which gamma_l is at most the threshold. Of the grains in the middle half of the bed that are "
      "overloaded at each threshold, this one has the l_c nearest to their means. {}",
      grain, first_run_text(failed), angle_text(frame.tilt), rounded_text(pictures::white_below, 2),
      reading_caption(failed.first()));
}

}  // namespace

std::optional<Index> typical_grain(const BedFrame& bed,
                                   std::span<const analysis::FrameThreshold> thresholds) {
  const std::vector<double> y = analysis::free_grain_values(bed.frame.y, bed.statics);
  if (y.empty()) return std::nullopt;
  const double top = *std::ranges::max_element(y);
  std::optional<Index> typical;
  double least = 0.0;
  for (Index i = 0; i < bed.statics.free_count; ++i) {
    if (!in_middle_half(y[i], top)) continue;
    if (!bed.statics.periodic && !in_middle_half(bed.frame.x[i], bed.statics.length)) continue;
    double distance = 0.0;
    for (const analysis::FrameThreshold& at : thresholds)
      distance += std::abs(static_cast<double>(at.lc[i]) / at.lc_mean - 1.0);
    if (std::isnan(distance) || (typical && distance >= least)) continue;
    typical = i;
    least = distance;
  }
  return typical;
}

Table grains_around(const BedFrame& bed, Index centre, double distance) {
  Table table{"grains",
              {{"x", "D", "centre, from the overloaded grain, along the bed", {}},
               {"y", "D", "the same, across the bed", {}},
               {"radius", "D", "radius", {}},
               {"gamma", "1", "stress ratio; NaN if a grain carries nothing", {}}}};
  const double diameter = bed.statics.mean_diameter;
  for (Index i = 0; i < bed.statics.free_count; ++i) {
    double dx = bed.frame.x[i] - bed.frame.x[centre];
    dx += analysis::nearest_image(dx, analysis::period_of(bed.statics)) * analysis::period_of(bed.statics);
    const double dy = bed.frame.y[i] - bed.frame.y[centre];
    if (std::hypot(dx, dy) > distance) continue;
    const double row[] = {dx / diameter, dy / diameter, bed.statics.radius[i] / diameter, bed.frame.gamma[i]};
    for (std::size_t c = 0; c < std::size(row); ++c) table.columns[c].values.push_back(row[c]);
  }
  return table;
}

std::optional<Figure> neighbourhoods_figure(std::span<const RunGroup> groups, const FrameWords& at) {
  const auto failed = first_failed_group(groups);
  if (!failed) return std::nullopt;
  const runs::RunView& run = failed->first();
  const RunStatics& statics = run.file->header().statics;
  const double diameter = statics.mean_diameter;
  const double tilt =
      at.empty() ? radians(paper_tilt) : run.analysis.frames.at(frames_of_run(run, at)[0]).tilt;
  const auto found = shown_grain(run, tilt);
  if (!found) return std::nullopt;
  const auto& [k, frame, grain] = *found;
  const BedFrame bed{frame, statics};

  std::vector<double> lengths;  // D
  for (const analysis::FrameThreshold& threshold : run.analysis.frames.at(k).thresholds)
    lengths.push_back(threshold.lc[grain] / diameter);
  const double shown = largest_shown(*std::ranges::max_element(lengths), run.analysis.lc_cut / diameter);
  Figure figure;
  figure.name = "fig11-neighbourhoods";
  figure.title = "Growing neighbourhoods of an overloaded grain (paper, Fig. 11)";
  figure.caption = caption_of(*failed, frame, grain);
  figure.runs = {run.path};
  figure.wide = true;
  figure.height_over_width = 0.5;
  figure.tables = {curve_table(analysis::neighbourhood_curve(bed, grain, shown * diameter), diameter),
                   grains_around(bed, grain, (0.5 * shown + 0.5) * diameter),
                   length_table(run.analysis, lengths)};
  set_variable(figure, "gamma_c", run.analysis.gamma_c);
  set_variable(figure, "white_below", pictures::white_below);
  set_variable(figure, "shown", shown);
  set_variable(figure, "grain_radius", statics.radius[grain] / diameter);
  set_variable(figure, "factors", word_list(all_of(&analysis::RunThreshold::factor, run.analysis)));
  set_variable(figure, "thresholds", word_list(all_of(&analysis::RunThreshold::gamma, run.analysis)));
  set_variable(figure, "lengths", word_list(lengths));
  return figure;
}

}  // namespace talus::figures
