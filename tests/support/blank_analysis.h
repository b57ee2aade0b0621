#pragma once
/// Analyses to be filled by hand.

#include "io/run_schema.h"

namespace talus::test {

/// Sizes of the arrays of an analysis, by the letters of its shapes.
struct AnalysisSizes {
  std::size_t frames = 1, thresholds = 0, grains = 1, sections = 1, bins = 1, layers = 1, events = 0;
};

/// Returns an analysis of these sizes, filled with NaN or 0.
inline analysis::Analysis blank_analysis(const AnalysisSizes& counts,
                                         std::span<const analysis::Quantity> table = analysis::quantities()) {
  analysis::Analysis analysis;
  analysis.thresholds.resize(counts.thresholds);
  analysis.frames.resize(counts.frames);
  analysis.events.resize(counts.events);
  for (analysis::FrameRecord& frame : analysis.frames) frame.thresholds.resize(counts.thresholds);
  const io::Sizes sizes = {{'T', counts.frames},   {'F', counts.thresholds}, {'N', counts.grains},
                           {'X', counts.sections}, {'B', counts.bins},       {'Y', counts.layers},
                           {'E', counts.events}};
  for (const analysis::Quantity& quantity : table) {
    if (!io::is_present(quantity, analysis)) continue;
    std::size_t count = 1;
    for (const std::uint64_t extent : io::dimensions(io::data_set_of(quantity), sizes)) count *= extent;
    analysis::Values values = analysis::values_of(quantity, analysis);
    std::visit(
        [&]<typename T>(std::vector<T>& numbers) {
          if (numbers.size() != count)
            numbers.assign(count, std::is_floating_point_v<T> ? static_cast<T>(not_known) : T(0));
        },
        values);
    analysis::set_values(quantity, values, analysis);
  }
  return analysis;
}

}  // namespace talus::test
