#include "figures/neighbourhoods_figure.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "analysis/cells.h"
#include "analysis/coarse_graining.h"
#include "analysis/free_grains.h"
#include "core/trigonometry.h"
#include "figures/failed_group.h"
#include "figures/run_means.h"
#include "maps/frame_choice.h"
#include "session/analysis_input.h"

namespace talus {
namespace {

constexpr double shown_tilt = 10.0;  // deg

/// The frame nearest to 10 deg, or the last before theta_c where that is less.
std::size_t shown_frame(const FigureRun& run) {
  const std::size_t repose = repose_frame(run);
  if (radians(shown_tilt) >= theta_c_of(run)) return repose;
  return std::min(frames_at(run.file.frame_tilts(), {rounded_text(shown_tilt, 0)}, theta_c_of(run)).front(),
                  repose);
}

bool in_middle_half(double value, double end) { return value >= 0.25 * end && value <= 0.75 * end; }

/// The largest neighbourhood that is shown, in D: well beyond l_c, an even number.
double largest_shown(double largest_l_c, double cut) {
  return std::min(std::max(8.0, 2.0 * std::ceil(largest_l_c)), cut);
}

Table curve_table(const NeighbourhoodCurve& curve, double diameter) {
  Table table{"",
              {{"l", "D", "diameter of the neighbourhood", {}},
               {"gamma_l", "1", "stress ratio of the summed internal moments of its grains", curve.gamma}}};
  for (const double l : curve.l) table.columns[0].values.push_back(l / diameter);
  return table;
}

Table length_table(const Analysis& analysis, std::span<const double> lengths) {
  const auto factors = values<double>(analysis, "threshold_factor");
  const auto thresholds = values<double>(analysis, "threshold");
  return {"l_c",
          {{"factor", "1", "threshold over Gamma_c", {factors.begin(), factors.end()}},
           {"threshold", "1", "threshold", {thresholds.begin(), thresholds.end()}},
           {"l_c", "D", "smallest l with gamma_l <= threshold", {lengths.begin(), lengths.end()}}}};
}

/// Numbers with blanks between them, as a text of gnuplot.
std::string word_list(std::span<const double> numbers) {
  std::string text;
  for (const double number : numbers) text.append(text.empty() ? "" : " ").append(rounded_text(number, 6));
  return gnuplot_quoted(text);
}

std::string caption_of(const FailedGroup& failed, const Frame& frame, Index grain) {
  return std::string("Left: grain ").append(std::to_string(grain)) + " of " + first_run_text(failed) +
         " at theta = " + angle_text(frame.tilt) +
         " deg, outlined, and the grains about it in the gray of their gamma. A neighbourhood of diameter l "
         "has "
         "all grains whose centres lie within the circle: thin circles every 2 D, thick ones at l_c. Right: "
         "stress ratio gamma_l of the neighbourhood over l; l_c is the smallest l, "
         "from that of gamma on, at which it is not above the threshold. Of the grains in the middle half of "
         "the bed that are overloaded at each threshold, it "
         "is "
         "the one whose l_c are nearest to their means. " +
         reading_caption(failed.first());
}

}  // namespace

std::optional<Index> typical_grain(const Frame& frame, const RunStatics& statics,
                                   std::span<const float> lengths, std::span<const double> means) {
  const std::vector<double> y = of_free_grains(frame.y, statics);
  if (y.empty()) return std::nullopt;
  const double top = *std::ranges::max_element(y);
  std::optional<Index> typical;
  double least = 0.0;
  for (Index i = 0; i < statics.free_count; ++i) {
    if (!in_middle_half(y[i], top)) continue;
    if (!statics.periodic && !in_middle_half(frame.x[i], statics.length)) continue;
    double distance = 0.0;
    for (std::size_t f = 0; f < means.size(); ++f)
      distance += std::abs(static_cast<double>(lengths[f * statics.radius.size() + i]) / means[f] - 1.0);
    if (std::isnan(distance) || (typical && distance >= least)) continue;
    typical = i;
    least = distance;
  }
  return typical;
}

Table grains_around(const Frame& frame, const RunStatics& statics, Index centre, double distance) {
  Table table{"grains",
              {{"x", "D", "centre, from the overloaded grain, along the bed", {}},
               {"y", "D", "the same, across the bed", {}},
               {"radius", "D", "radius", {}},
               {"gamma", "1", "stress ratio; NaN where a grain carries nothing", {}}}};
  const double diameter = statics.mean_diameter;
  for (Index i = 0; i < statics.free_count; ++i) {
    double dx = frame.x[i] - frame.x[centre];
    dx += nearest_image(dx, period_of(statics)) * period_of(statics);
    const double dy = frame.y[i] - frame.y[centre];
    if (std::hypot(dx, dy) > distance) continue;
    const double row[] = {dx / diameter, dy / diameter, statics.radius[i] / diameter, frame.gamma[i]};
    for (std::size_t c = 0; c < std::size(row); ++c) table.columns[c].values.push_back(row[c]);
  }
  return table;
}

std::optional<Figure> neighbourhoods_figure(std::span<const RunGroup> groups) {
  const auto failed = first_failed_group(groups);
  if (!failed) return std::nullopt;
  const FigureRun& run = failed->first();
  const RunStatics& statics = run.file.header().statics;
  const double diameter = statics.mean_diameter;
  const std::size_t k = shown_frame(run);
  const Frame frame = analysed_frame(run.file, from_facts(run.analysis.parameters), k);
  const auto all_lengths = row<float>(run.analysis, "lc/length", k);
  const auto grain = typical_grain(frame, statics, all_lengths, row<double>(run.analysis, "lc/mean", k));
  if (!grain) return std::nullopt;

  std::vector<double> lengths;  // D
  for (std::size_t f = 0; f < values<double>(run.analysis, "threshold").size(); ++f)
    lengths.push_back(all_lengths[f * statics.radius.size() + *grain] / diameter);
  const double shown =
      largest_shown(*std::ranges::max_element(lengths), values<double>(run.analysis, "lc/cut")[0] / diameter);
  Figure figure;
  figure.name = "fig11-neighbourhoods";
  figure.title = "Growing neighbourhoods of an overloaded grain (paper, Fig. 11)";
  figure.caption = caption_of(*failed, frame, *grain);
  figure.runs = {run.path};
  figure.wide = true;
  figure.height_over_width = 0.5;
  figure.tables = {curve_table(neighbourhood_curve(frame, statics, *grain, shown * diameter), diameter),
                   grains_around(frame, statics, *grain, (0.5 * shown + 0.5) * diameter),
                   length_table(run.analysis, lengths)};
  set_variable(figure, "shown", shown);
  set_variable(figure, "grain_radius", statics.radius[*grain] / diameter);
  const auto factors = values<double>(run.analysis, "threshold_factor");
  const auto thresholds = values<double>(run.analysis, "threshold");
  set_variable(figure, "factors", word_list(factors));
  set_variable(figure, "thresholds", word_list(thresholds));
  set_variable(figure, "lengths", word_list(lengths));
  return figure;
}

}  // namespace talus
