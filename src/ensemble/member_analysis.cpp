#include "ensemble/member_analysis.h"

#include <algorithm>
#include <cmath>

#include "analysis/quantities.h"
#include "core/trigonometry.h"
#include "runs/analysis_parameters.h"

namespace talus {
namespace {

std::size_t count_thresholds(const MemberNumbers& numbers) {
  const std::string& factor = quantity_of(&RunThreshold::factor).name;
  std::size_t count = 0;
  while (!std::isnan(number_called(numbers, element_name(factor, count)))) ++count;
  return count;
}

void set_number_of_run(const Quantity& quantity, const MemberNumbers& numbers, double mean_diameter,
                       Analysis& analysis) {
  auto values = std::get<std::vector<double>>(values_of(quantity, analysis));
  for (std::size_t k = 0; k < values.size(); ++k)
    values[k] =
        unscaled(quantity.unit, number_called(numbers, element_name(quantity.name, k)), mean_diameter);
  if (!values.empty()) set_values(quantity, values, analysis);
}

void set_number_of_frames(const Quantity& quantity, const MemberSeries& series, double mean_diameter,
                          Analysis& analysis) {
  const std::size_t count = needs_threshold(quantity) ? analysis.thresholds.size() : 1;
  for (std::size_t f = 0; f < count; ++f) {
    const auto found = std::ranges::find(series.series, element_name(quantity.name, f), &NamedSeries::name);
    if (found == series.series.end()) continue;
    for (std::size_t k = 0; k < analysis.frames.size(); ++k)
      set_number(quantity, unscaled(quantity.unit, found->values[k], mean_diameter), analysis.frames[k], f);
  }
}

}  // namespace

Analysis analysis_of(const MemberResult& member, double mean_diameter) {
  Analysis analysis;
  analysis.parameters = as_facts(AnalysisParameters{});
  analysis.thresholds.resize(count_thresholds(member.numbers));
  for (const double theta : member.series.theta) {
    FrameRecord& frame = analysis.frames.emplace_back();
    frame.tilt = radians(theta);
    frame.thresholds.resize(analysis.thresholds.size());
  }
  for (const Quantity& quantity : quantities()) {
    if (is_number_of_run(quantity)) set_number_of_run(quantity, member.numbers, mean_diameter, analysis);
    if (is_number_of_frame(quantity)) set_number_of_frames(quantity, member.series, mean_diameter, analysis);
  }
  return analysis;
}

RunView view_of_values(const std::string& path, const MemberResult& member,
                       const std::string& scenario_text) {
  RunView run;
  run.path = path;
  run.scenario = parse_scenario(scenario_text, path);
  run.scenario.seed = member.seed;
  run.scenario_text = scenario_text;
  run.state_hash = member.numbers.state_hash;
  run.statics.mean_diameter = run.scenario.grains.mean_diameter;
  run.analysis = analysis_of(member, run.statics.mean_diameter);
  run.theta_r = radians(number_called(member.numbers, "theta_r"));
  return run;
}

}  // namespace talus
