#include "view/frame_values.h"

#include <cmath>

#include "analysis/frame_analysis.h"
#include "core/trigonometry.h"
#include "io/packed_file.h"
#include "runs/analysis_parameters.h"
#include "runs/analysis_run.h"

namespace talus::view {
namespace {

bool is_near(double one, double other) { return std::abs(one - other) <= 1e-9 * std::abs(other); }

}  // namespace

analysis::CoarseGrainingRule coarse_graining_rule(const pictures::OverloadRule& rule,
                                                  const RunStatics& statics) {
  const double threshold = pictures::threshold_of(rule);
  return {.threshold = threshold,
          .end_ratio = threshold,
          .l_min = rule.l_min * statics.mean_diameter,
          .cut = analysis::length_cut(statics, rule.l_min)};
}

analysis::FrameRecord overload_record(const BedFrame& bed, const analysis::Clusters& clusters,
                                      const pictures::OverloadRule& rule) {
  analysis::FrameThreshold at;
  analysis::measure_overloaded(stress::count_overloaded(bed, pictures::threshold_of(rule)), bed.statics, at);
  analysis::measure_lengths(analysis::coarse_graining(bed, coarse_graining_rule(rule, bed.statics)), at);
  analysis::measure_clusters(clusters, analysis::bed_edges(bed), at);
  return {.tilt = bed.frame.tilt, .thresholds = {at}};
}

std::optional<analysis::Analysis> read_usable_analysis(const io::RunFile& run) {
  if (!run.complete()) return std::nullopt;
  std::optional<analysis::Analysis> analysis = io::read_analysis(run);
  if (!analysis) return std::nullopt;
  const analysis::AnalysisParameters parameters = runs::from_facts(analysis->parameters);
  const bool single_frames = parameters.averaging == 0.0 && parameters.min_contacts == 1;
  const bool same_cut =
      is_near(analysis->lc_cut, analysis::length_cut(run.header().statics, parameters.l_min));
  if (!single_frames || !same_cut || analysis->key != runs::analysis_key(run, parameters))
    return std::nullopt;
  return analysis;
}

std::optional<std::size_t> find_threshold(const analysis::Analysis& analysis,
                                          const pictures::OverloadRule& rule) {
  const analysis::AnalysisParameters parameters = runs::from_facts(analysis.parameters);
  const bool neighbours = parameters.joining == analysis::Joining::neighbours;
  if (neighbours != rule.joined_by_neighbours || parameters.l_min != rule.l_min) return std::nullopt;
  const double wanted = pictures::threshold_of(rule);
  for (std::size_t f = 0; f < analysis.thresholds.size(); ++f)
    if (is_near(analysis.thresholds[f].gamma, wanted) && is_near(analysis.thresholds[f].end_ratio, wanted))
      return f;
  return std::nullopt;
}

std::vector<analysis::FrameRecord> stored_records(const analysis::Analysis& analysis, std::size_t f) {
  std::vector<analysis::FrameRecord> records;
  for (const analysis::FrameRecord& frame : analysis.frames) {
    records.push_back({.tilt = frame.tilt, .thresholds = {frame.thresholds[f]}});
    records.back().thresholds[0].lc.clear();
    records.back().thresholds[0].cluster.clear();
  }
  return records;
}

}  // namespace talus::view
