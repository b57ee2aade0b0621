#include "figures/ranking_figure.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <iterator>

#include "analysis/quantities.h"
#include "core/statistics.h"
#include "core/trigonometry.h"
#include "ensemble/averages.h"
#include "figures/group_table.h"
#include "figures/run_means.h"

namespace talus {
namespace {

constexpr double step = 0.25, farthest = 8.0;  // deg
constexpr double far_from = 5.0, far_to = 10.0;
constexpr std::size_t fewest_runs = 8;
constexpr double told_at[] = {1.0, 2.0, 3.0};
constexpr std::size_t rows_drawn = 30;

/// One measure in all runs of a group: its change since far from failure, at each distance.
struct Measure {
  FrameColumn column;
  std::string label;
  bool by_own_failure = false;
  BedCurves changes;
};

/// What a measure is at each distance in one run, and far from failure.
struct RunReadings {
  std::vector<double> near;
  double far = not_known;
};

double mean_between(const std::vector<double>& tilts, const std::vector<double>& values, double from,
                    double to) {
  std::vector<double> chosen;
  for (std::size_t k = 0; k < tilts.size(); ++k)
    if (tilts[k] >= from && tilts[k] <= to) chosen.push_back(values[k]);
  return statistics_of(chosen).mean;
}

/// Whether it is above zero wherever it is known.
bool is_positive(const std::vector<RunReadings>& runs) {
  const auto positive = [](double value) { return std::isnan(value) || value > 0.0; };
  return std::ranges::all_of(runs, [&](const RunReadings& run) {
    return positive(run.far) && std::ranges::all_of(run.near, positive);
  });
}

BedCurves changes_of(const std::vector<RunReadings>& runs) {
  const bool by_ratio = is_positive(runs);
  BedCurves changes;
  for (const RunReadings& run : runs) {
    std::vector<double>& change = changes.emplace_back();
    for (const double value : run.near)
      change.push_back(by_ratio ? std::log(value / run.far) : value - run.far);
  }
  return changes;
}

/// Every number of a frame; of those at a threshold, one for each threshold.
std::vector<Measure> measures_of(const RunChoice& runs) {
  const Analysis& first = runs.front()->analysis;
  const bool own_thresholds =
      std::ranges::any_of(runs, [&](const RunView* run) { return run->analysis.gamma_c != first.gamma_c; });
  std::vector<Measure> measures;
  for (const Quantity& quantity : quantities()) {
    if (!is_number_of_frame(quantity)) continue;
    const std::size_t count = needs_threshold(quantity) ? first.thresholds.size() : 1;
    for (std::size_t f = 0; f < count; ++f) {
      const std::string& title = quantity.display.title;
      Measure measure{
          column_of(f == 0 ? quantity.name : fmt::format("{}[{}]", quantity.name, f), quantity, f),
          title.empty() ? quantity.name : title,
          needs_threshold(quantity) && own_thresholds,
          {}};
      if (f > 0) measure.label += fmt::format(" ({:g} Γ_c)", first.thresholds[f].factor);
      measures.push_back(std::move(measure));
    }
  }
  return measures;
}

void read_changes(std::vector<Measure>& measures, const RunChoice& runs) {
  std::vector<FrameColumn> columns;
  for (const Measure& measure : measures) columns.push_back(measure.column);
  std::vector<std::vector<RunReadings>> readings(measures.size(), std::vector<RunReadings>(runs.size()));
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const std::vector<Column> table = runs_one_by_one({&runs[r], 1}, columns);
    const std::vector<double>& tilts = table[1].values;
    const double theta_c = degrees(theta_c_of(*runs[r]));
    for (std::size_t m = 0; m < measures.size(); ++m) {
      const std::vector<double>& values = table[2 + m].values;
      RunReadings& reading = readings[m][r];
      reading.far = mean_between(tilts, values, far_from, far_to);
      for (const double distance : distances_of_ranking())
        reading.near.push_back(interpolated(tilts, values, theta_c - distance));
    }
  }
  for (std::size_t m = 0; m < measures.size(); ++m) measures[m].changes = changes_of(readings[m]);
}

std::size_t index_of(double distance) { return static_cast<std::size_t>(std::lround(distance / step)) - 1; }

/// The change at a distance, over its standard deviation.
double contrast_at(const BedCurves& changes, double distance) {
  std::vector<double> values;
  for (const std::vector<double>& change : changes) values.push_back(change[index_of(distance)]);
  const Statistics statistics = statistics_of(values);
  return statistics.mean / statistics.deviation;
}

/// What is told by the measure alone, and with the tilt.
RankedMeasure ranked(const Measure& measure, const BedCurves& tilts, const DistanceTold& by_tilt) {
  RankedMeasure result{.name = measure.column.name,
                       .label = measure.label,
                       .definition = measure.column.meaning,
                       .by_own_failure = measure.by_own_failure};
  const std::vector<double> distances = distances_of_ranking();
  const DistanceTold alone = distance_told(distances, measure.changes);
  const DistanceTold with_tilt = distance_told(distances, measure.changes, tilts);
  const Statistics gain = paired_difference(by_tilt.mean_square, with_tilt.mean_square);
  for (const double distance : told_at) {
    result.contrast.push_back(contrast_at(measure.changes, distance));
    result.error_at.push_back(alone.error[index_of(distance)]);
  }
  result.error = root_mean_square(alone.mean_square);
  result.error_with_tilt = root_mean_square(with_tilt.mean_square);
  result.gain = gain.mean;
  result.gain_error = gain.error;
  result.beds = alone.beds;
  return result;
}

RankedMeasure ranked_tilt(const DistanceTold& by_tilt) {
  RankedMeasure result{.name = "tilt", .label = "Tilt θ alone", .definition = "tilt of the bed"};
  for (const double distance : told_at) {
    result.contrast.push_back(not_known);
    result.error_at.push_back(by_tilt.error[index_of(distance)]);
  }
  result.error = result.error_with_tilt = root_mean_square(by_tilt.mean_square);
  result.beds = by_tilt.beds;
  return result;
}

/// The tilt of each run at each distance, deg.
BedCurves tilts_of(const RunChoice& runs) {
  BedCurves tilts;
  for (const RunView* run : runs) {
    std::vector<double>& tilt = tilts.emplace_back();
    for (const double distance : distances_of_ranking()) tilt.push_back(degrees(theta_c_of(*run)) - distance);
  }
  return tilts;
}

/// The columns of the table, and which number of a measure stands in each.
struct RankingColumn {
  Column column;
  double (*value)(const RankedMeasure&);
};

std::vector<RankingColumn> ranking_columns() {
  using M = RankedMeasure;
  return {
      {{"beds", "1", "beds that have it", {}}, [](const M& m) { return static_cast<double>(m.beds); }},
      {{"contrast_1",
        "1",
        "mean change since far from failure, over its deviation, 1 deg before theta_c",
        {}},
       [](const M& m) { return m.contrast[0]; }},
      {{"contrast_2", "1", "the same, 2 deg before", {}}, [](const M& m) { return m.contrast[1]; }},
      {{"contrast_3", "1", "the same, 3 deg before", {}}, [](const M& m) { return m.contrast[2]; }},
      {{"error", "deg", "rms error of the distance told by it alone, over all distances", {}},
       [](const M& m) { return m.error.value; }},
      {{"error_error", "deg", "its standard error", {}}, [](const M& m) { return m.error.error; }},
      {{"error_1", "deg", "rms error 1 deg before theta_c", {}}, [](const M& m) { return m.error_at[0]; }},
      {{"error_2", "deg", "rms error 2 deg before theta_c", {}}, [](const M& m) { return m.error_at[1]; }},
      {{"error_3", "deg", "rms error 3 deg before theta_c", {}}, [](const M& m) { return m.error_at[2]; }},
      {{"with_tilt", "deg", "rms error of the distance told by it and the tilt", {}},
       [](const M& m) { return m.error_with_tilt.value; }},
      {{"with_tilt_error", "deg", "its standard error", {}},
       [](const M& m) { return m.error_with_tilt.error; }},
      {{"gain", "deg^2", "mean square error of the tilt less that with the measure, bed by bed", {}},
       [](const M& m) { return m.gain; }},
      {{"gain_error", "deg^2", "its standard error", {}}, [](const M& m) { return m.gain_error; }},
      {{"own_threshold", "1", "1: at thresholds that follow from the theta_c of each bed", {}},
       [](const M& m) { return m.by_own_failure ? 1.0 : 0.0; }},
  };
}

Table ranking_table(const std::vector<RankedMeasure>& measures) {
  Table table{"", {{"rank", "1", "by the error of the measure alone", {}}}};
  for (std::size_t k = 0; k < measures.size(); ++k) {
    table.columns[0].values.push_back(static_cast<double>(k + 1));
    table.columns[0].meaning += fmt::format("{} {} {}", k == 0 ? ":" : ";", k + 1, measures[k].name);
  }
  for (auto& [column, value] : ranking_columns()) {
    std::ranges::transform(measures, std::back_inserter(column.values), value);
    table.columns.push_back(std::move(column));
  }
  return table;
}

/// What a row of the chart is called: titles have subscripts, names do not.
std::string row_text(const RankedMeasure& measure) {
  const std::string text = measure.label + (measure.by_own_failure ? " *" : "");
  const bool is_name = measure.name.starts_with(measure.label.substr(0, measure.label.find(' ')));
  return is_name ? gnuplot_quoted(text) : gnuplot_string(text);
}

/// The error of who knows nothing: the standard deviation of the distances.
double error_of_nothing() {
  const double n = farthest / step;
  return step * std::sqrt((n * n - 1.0) / 12.0);
}

std::string ranking_caption(const RunGroup& group, const std::vector<RankedMeasure>& measures,
                            std::size_t drawn, std::size_t runs) {
  std::string text = fmt::format(
      "How well each measure of a frame tells the distance theta_c - theta of a single bed from its failure, "
      "up to {:g} deg: {}, {}. A measure is compared with the same bed's mean from {:g} to {:g} deg of tilt. "
      "(a) Its change since then, over the standard deviation of the beds, 1, 2 and 3 deg before theta_c. "
      "(b) "
      "Root mean square error of the distance that the measure tells when it is calibrated with all other "
      "beds: alone (filled), and together with the tilt (open), with standard errors. Dashed: who knows the "
      "tilt alone; dotted: who knows nothing. ",
      farthest, group.label, runs_text(runs), far_from, far_to);
  if (drawn < measures.size())
    text += fmt::format("The {} best of {} measures; the table has all. ", drawn, measures.size());
  if (std::ranges::any_of(measures, &RankedMeasure::by_own_failure))
    text +=
        "* At a threshold that follows from the theta_c of the bed, which an observer does not know "
        "beforehand; with --set gamma_c=... it is the same for all.";
  return text;
}

}  // namespace

std::vector<double> distances_of_ranking() {
  std::vector<double> distances;
  for (int k = 1; k * step <= farthest; ++k) distances.push_back(k * step);
  return distances;
}

std::vector<RankedMeasure> ranked_measures(const RunGroup& group) {
  const RunChoice runs = failed_runs(group);
  const BedCurves tilts = tilts_of(runs);
  const DistanceTold by_tilt = distance_told(distances_of_ranking(), tilts);
  std::vector<Measure> measures = measures_of(runs);
  read_changes(measures, runs);
  std::vector<RankedMeasure> result = {ranked_tilt(by_tilt)};
  for (const Measure& measure : measures) {
    RankedMeasure one = ranked(measure, tilts, by_tilt);
    if (!std::isnan(one.error.value) && one.beds + fewest_to_calibrate > runs.size())
      result.push_back(std::move(one));
  }
  std::ranges::stable_sort(result, {}, [](const RankedMeasure& measure) { return measure.error.value; });
  return result;
}

std::optional<Figure> ranking_figure(std::span<const RunGroup> groups) {
  for (const RunGroup& group : groups) {
    const RunChoice runs = failed_runs(group);
    if (runs.size() < fewest_runs) continue;
    const std::vector<RankedMeasure> measures = ranked_measures(group);
    const std::size_t drawn = std::min(rows_drawn, measures.size());
    Figure figure;
    figure.name = "precursor-ranking";
    figure.title = "What announces failure best";
    figure.caption = ranking_caption(group, measures, drawn, runs.size());
    for (const RunView* run : runs) figure.runs.push_back(run->path);
    figure.wide = true;
    figure.height_over_width = (1.9 + 0.36 * static_cast<double>(drawn)) / 17.8;
    figure.tables = {ranking_table(measures)};
    figure.groups = 1;
    for (std::size_t k = 0; k < drawn; ++k)
      set_variable(figure, fmt::format("row_{}", k + 1), row_text(measures[k]));
    set_variable(figure, "rows", static_cast<double>(drawn));
    set_variable(figure, "nothing", error_of_nothing());
    const auto tilt = std::ranges::find(measures, "tilt", &RankedMeasure::name);
    set_variable(figure, "tilt", tilt->error.value);
    set_variable(figure, "tilt_row", static_cast<double>(tilt - measures.begin() + 1));
    return figure;
  }
  return std::nullopt;
}

}  // namespace talus
