#include "view/frame_values.h"

#include <algorithm>
#include <cmath>

#include "analysis/coarse_graining.h"
#include "core/trigonometry.h"
#include "io/analysis_file.h"
#include "session/analysis_run.h"
#include "stress/overload.h"

namespace talus {
namespace {

bool is_near(double one, double other) { return std::abs(one - other) <= 1e-9 * std::abs(other); }

}  // namespace

OverloadRule overload_rule(const MapSettings& settings) {
  return {settings.theta_c, settings.threshold_factor, settings.joined_by_neighbours, settings.l_min};
}

double threshold_of(const OverloadRule& rule) { return rule.threshold_factor * sine(rule.theta_c); }

double length_cut(const RunStatics& statics, double l_min) {
  return std::max(l_min * statics.mean_diameter, std::min(statics.depth, 0.5 * statics.length));
}

FrameValues overload_values(const Frame& frame, const RunStatics& statics, const OverloadRule& rule) {
  const double threshold = threshold_of(rule);
  const CoarseGraining lc = coarse_graining(frame, statics,
                                            {.threshold = threshold,
                                             .end_ratio = threshold,
                                             .l_min = rule.l_min * statics.mean_diameter,
                                             .cut = length_cut(statics, rule.l_min)});
  FrameValues values;
  values.tilt = frame.tilt;
  values.overloaded = count_overloaded(frame, statics, threshold).fraction();
  values.mean_length = lc.mean / statics.mean_diameter;
  values.largest_length = lc.largest / statics.mean_diameter;
  return values;
}

std::optional<Analysis> read_usable_analysis(const std::string& path, const RunFile& run) {
  if (!run.complete()) return std::nullopt;
  std::optional<Analysis> analysis = read_analysis(path);
  if (!analysis) return std::nullopt;
  const AnalysisParameters parameters = from_facts(analysis->parameters);
  const bool single_frames = parameters.averaging == 0.0 && parameters.min_contacts == 1;
  const bool same_cut =
      is_near(values<double>(*analysis, "lc/cut")[0], length_cut(run.header().statics, parameters.l_min));
  if (!single_frames || !same_cut || analysis->key != analysis_key(run, parameters)) return std::nullopt;
  return analysis;
}

std::optional<std::size_t> find_threshold(const Analysis& analysis, const OverloadRule& rule) {
  const AnalysisParameters parameters = from_facts(analysis.parameters);
  const bool neighbours = parameters.joining == Joining::neighbours;
  if (neighbours != rule.joined_by_neighbours || parameters.l_min != rule.l_min) return std::nullopt;
  const double wanted = threshold_of(rule);
  for (std::size_t f = 0; f < analysis.sizes.at('F'); ++f)
    if (is_near(values<double>(analysis, "threshold")[f], wanted) &&
        is_near(values<double>(analysis, "lc/end_ratio")[f], wanted))
      return f;
  return std::nullopt;
}

std::vector<FrameValues> stored_values(const Analysis& analysis, std::size_t f, const RunStatics& statics,
                                       const std::vector<double>& tilts) {
  std::vector<FrameValues> frames(tilts.size());
  for (std::size_t k = 0; k < tilts.size(); ++k) {
    const auto value = [&](const char* name) { return row<double>(analysis, name, k)[f]; };
    frames[k] = {.tilt = tilts[k],
                 .overloaded = value("overloaded/fraction"),
                 .largest_share = value("clusters/largest_share"),
                 .mean_length = value("lc/mean") / statics.mean_diameter,
                 .largest_length = value("lc/max") / statics.mean_diameter,
                 .spans = row<Index>(analysis, "clusters/spans_depth", k)[f] != 0};
  }
  return frames;
}

}  // namespace talus
