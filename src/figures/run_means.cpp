#include "figures/run_means.h"

#include <algorithm>
#include <cmath>

#include "core/statistics.h"
#include "core/trigonometry.h"
#include "ensemble/averages.h"

namespace talus::figures {
namespace {

constexpr double same_tilt = 1e-6;  // rad; frames of a run are at least 1e-8 deg apart, in practice 0.01 deg

/// Returns the last rise of a run, which ends at theta_c if the run failed.
analysis::FramesOfRise rise_to_failure(const runs::RunView& run) {
  analysis::FramesOfRise rise = runs::last_rise_of(run);
  const double theta_c = theta_c_of(run);
  std::erase_if(rise.tilts, [&](double tilt) { return tilt > theta_c; });
  return rise;
}

/// Values of the columns in the frames of one run, up to theta_c.
struct RunCurve {
  std::vector<double> angles;               ///< rad, ascending
  std::vector<std::vector<double>> values;  ///< values of each column, at each angle
};

RunCurve curve_over_tilt(const runs::RunView& run, std::span<const FrameColumn> columns) {
  analysis::FramesOfRise rise = rise_to_failure(run);
  RunCurve curve{std::move(rise.tilts), {}};
  for (const FrameColumn& column : columns) {
    std::vector<double>& values = curve.values.emplace_back();
    for (std::size_t frame = 0; frame < curve.angles.size(); ++frame)
      values.push_back((column.has_side && rise.mirrored_slope ? -1.0 : 1.0) *
                       column.value(run, rise.first + frame));
  }
  return curve;
}

/// Returns a curve at multiples of the spacing of frames below theta_c, interpolated between frames.
RunCurve curve_before_failure(const runs::RunView& run, std::span<const FrameColumn> columns) {
  const RunCurve over_tilt = curve_over_tilt(run, columns);
  const double theta_c = run.analysis.theta_c, spacing = radians(run.scenario.output.frame_every);
  RunCurve curve{{}, std::vector<std::vector<double>>(columns.size())};
  if (std::isnan(theta_c) || over_tilt.angles.empty()) return curve;
  for (int k = 0; theta_c - k * spacing > over_tilt.angles.front() - same_tilt; ++k) {
    std::vector<double> row;
    for (const std::vector<double>& values : over_tilt.values)
      row.push_back(ensemble::interpolated(over_tilt.angles, values, theta_c - k * spacing));
    if (std::ranges::all_of(row, [](double value) { return std::isnan(value); })) continue;
    curve.angles.push_back(k * spacing);
    for (std::size_t c = 0; c < row.size(); ++c) curve.values[c].push_back(row[c]);
  }
  return curve;
}

RunCurve curve_of(const runs::RunView& run, std::span<const FrameColumn> columns, Abscissa abscissa) {
  return abscissa == Abscissa::tilt ? curve_over_tilt(run, columns) : curve_before_failure(run, columns);
}

void name_angle(Column& angle, Abscissa abscissa) {
  if (abscissa == Abscissa::tilt) return;
  angle.name = "angle_left";
  angle.meaning = "theta_c - theta, with the theta_c of each run";
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
  std::vector<Column> columns = {{"theta", "deg", "tilt", {}}, {"n", "1", "number of runs in the row", {}}};
  for (std::size_t k = 0; k < common.tilts.size(); ++k) {
    columns[0].values.push_back(degrees(common.tilts[k]));
    columns[1].values.push_back(static_cast<double>(common.samples[k].size()));
  }
  return columns;
}

std::vector<Column> mean_columns(const CommonTilts& common, std::span<const std::vector<double>> values,
                                 Column mean) {
  Column error{mean.name + "_error", mean.unit, "its standard error over the runs", {}};
  Column deviation{mean.name + "_deviation", mean.unit, "its standard deviation over the runs", {}};
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

double theta_c_of(const runs::RunView& run) { return run.analysis.theta_c; }

std::size_t frame_nearest(const runs::RunView& run, double tilt) {
  const analysis::FramesOfRise rise = runs::last_rise_of(run);
  const auto distance = [tilt](double other) { return std::abs(other - tilt); };
  return rise.first +
         static_cast<std::size_t>(std::ranges::min_element(rise.tilts, {}, distance) - rise.tilts.begin());
}

bool has_frame_near(const runs::RunView& run, double tilt) {
  const double theta_c = theta_c_of(run);
  return std::isnan(theta_c) ? runs::last_rise_of(run).tilts.back() > tilt - same_tilt : theta_c > tilt;
}

FrameColumn column_of(const std::string& name, const analysis::Quantity& quantity, std::size_t f) {
  return {name, analysis::scaled_unit(quantity.unit), quantity.definition,
          [quantity, f](const runs::RunView& run, std::size_t frame) {
            return analysis::scaled(quantity.unit,
                                    analysis::number_of(quantity, run.analysis.frames.at(frame), f),
                                    run.statics.mean_diameter);
          },
          analysis::has_side(quantity)};
}

std::vector<Column> means_over_runs(std::span<const runs::RunView* const> runs,
                                    std::span<const FrameColumn> columns_of_frames, Abscissa abscissa) {
  std::vector<RunCurve> curves;
  std::vector<std::vector<double>> angles;
  for (const runs::RunView* run : runs) {
    curves.push_back(curve_of(*run, columns_of_frames, abscissa));
    angles.push_back(curves.back().angles);
  }
  const CommonTilts common = common_tilts(angles);
  std::vector<Column> columns = tilt_columns(common);
  name_angle(columns[0], abscissa);
  for (std::size_t c = 0; c < columns_of_frames.size(); ++c) {
    std::vector<std::vector<double>> rows;
    for (const RunCurve& curve : curves) rows.push_back(curve.values[c]);
    const FrameColumn& column = columns_of_frames[c];
    for (Column& mean : mean_columns(common, rows, {column.name, column.unit, column.meaning, {}}))
      columns.push_back(std::move(mean));
  }
  return columns;
}

std::vector<Column> individual_runs(std::span<const runs::RunView* const> runs,
                                    std::span<const FrameColumn> columns_of_frames, Abscissa abscissa) {
  std::vector<Column> columns = {{"seed", "1", "seed of the run", {}}, {"theta", "deg", "tilt", {}}};
  name_angle(columns[1], abscissa);
  for (const FrameColumn& column : columns_of_frames)
    columns.push_back({column.name, column.unit, column.meaning, {}});
  for (const runs::RunView* run : runs.first(std::min(runs.size(), max_runs_drawn))) {
    const RunCurve curve = curve_of(*run, columns_of_frames, abscissa);
    for (std::size_t k = 0; k < curve.angles.size(); ++k) {
      columns[0].values.push_back(static_cast<double>(run->scenario.seed));
      columns[1].values.push_back(degrees(curve.angles[k]));
      for (std::size_t c = 0; c < curve.values.size(); ++c)
        columns[c + 2].values.push_back(curve.values[c][k]);
    }
  }
  return columns;
}

}  // namespace talus::figures
