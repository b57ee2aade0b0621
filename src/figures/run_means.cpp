#include "figures/run_means.h"

#include <algorithm>
#include <cmath>

#include "core/statistics.h"
#include "core/trigonometry.h"

namespace talus {
namespace {

constexpr double same_tilt = 1e-6;  // rad; frames of a run are at least 1e-8 deg apart, in practice 0.01 deg

/// The tilts of a run that failed end at its theta_c.
std::vector<double> tilts_to_failure(const FigureRun& run) {
  std::vector<double> tilts = frame_tilts(run);
  const double theta_c = theta_c_of(run);
  std::erase_if(tilts, [&](double tilt) { return tilt > theta_c; });
  return tilts;
}

}  // namespace

CommonTilts common_tilts(std::span<const std::vector<double>> tilts) {
  std::vector<std::pair<double, Sample>> all;
  for (std::size_t run = 0; run < tilts.size(); ++run)
    for (std::size_t frame = 0; frame < tilts[run].size(); ++frame)
      all.push_back({tilts[run][frame], {run, frame}});
  std::ranges::stable_sort(all, {}, [](const auto& item) { return item.first; });
  CommonTilts common;
  for (auto first = all.begin(); first != all.end();) {
    const auto last = std::find_if(first, all.end(),
                                   [&](const auto& item) { return item.first > first->first + same_tilt; });
    std::vector<Sample> samples;
    std::transform(first, last, std::back_inserter(samples), [](const auto& item) { return item.second; });
    std::ranges::sort(samples, {}, &Sample::run);
    if (2 * samples.size() >= tilts.size()) {
      common.tilts.push_back(first->first);
      common.samples.push_back(std::move(samples));
    }
    first = last;
  }
  return common;
}

std::vector<Column> tilt_columns(const CommonTilts& common) {
  std::vector<Column> columns = {{"theta", "deg", "tilt", {}}, {"n", "1", "runs behind the row", {}}};
  for (std::size_t k = 0; k < common.tilts.size(); ++k) {
    columns[0].values.push_back(degrees(common.tilts[k]));
    columns[1].values.push_back(static_cast<double>(common.samples[k].size()));
  }
  return columns;
}

std::vector<Column> mean_columns(const CommonTilts& common, std::span<const std::vector<double>> values,
                                 Column mean) {
  Column error{mean.name + "_error", mean.unit, "its standard error over the runs", {}};
  Column deviation{mean.name + "_deviation", mean.unit, "the standard deviation of the runs", {}};
  for (const std::vector<Sample>& samples : common.samples) {
    std::vector<double> row;
    for (const auto& [run, frame] : samples) row.push_back(values[run][frame]);
    const Statistics result = statistics_of(row);
    mean.values.push_back(result.mean);
    error.values.push_back(result.error);
    deviation.values.push_back(result.deviation);
  }
  return {std::move(mean), std::move(error), std::move(deviation)};
}

double theta_c_of(const FigureRun& run) { return run.analysis.theta_c; }

std::size_t frame_nearest(const FigureRun& run, double tilt) {
  const std::vector<double> tilts = frame_tilts(run);
  const auto distance = [tilt](double other) { return std::abs(other - tilt); };
  return static_cast<std::size_t>(std::ranges::min_element(tilts, {}, distance) - tilts.begin());
}

bool stands_at(const FigureRun& run, double tilt) {
  const double theta_c = theta_c_of(run);
  return std::isnan(theta_c) ? run.analysis.frames.back().tilt > tilt - same_tilt : theta_c > tilt;
}

FrameColumn column_of(const std::string& name, const Quantity& quantity, std::size_t f) {
  return {name, scaled_unit(quantity), quantity.definition,
          [quantity, f](const FigureRun& run, std::size_t frame) {
            return scaled(quantity, number_of(quantity, run.analysis.frames.at(frame), f), run.mean_diameter);
          }};
}

std::vector<Column> means_over_runs(std::span<const FigureRun* const> runs,
                                    std::span<const FrameColumn> columns_of_frames) {
  std::vector<std::vector<double>> tilts;
  for (const FigureRun* run : runs) tilts.push_back(tilts_to_failure(*run));
  const CommonTilts common = common_tilts(tilts);
  std::vector<Column> columns = tilt_columns(common);
  for (const FrameColumn& column : columns_of_frames) {
    std::vector<std::vector<double>> rows(runs.size());
    for (std::size_t r = 0; r < runs.size(); ++r)
      for (std::size_t frame = 0; frame < tilts[r].size(); ++frame)
        rows[r].push_back(column.value(*runs[r], frame));
    for (Column& mean : mean_columns(common, rows, {column.name, column.unit, column.meaning, {}}))
      columns.push_back(std::move(mean));
  }
  return columns;
}

}  // namespace talus
