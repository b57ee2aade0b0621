#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <limits>

#include "base/text.h"
#include "core/trigonometry.h"
#include "figures/group_table.h"
#include "figures/recipes.h"
#include "figures/run_means.h"
#include "scenario/text.h"

namespace talus::figures {
namespace {

constexpr double seconds_before_failure = 2.0;

RunChoice runs_at_rest(const RunGroup& group) {
  RunChoice runs = all_runs(group);
  std::erase_if(runs, [](const runs::RunView* run) { return std::isnan(run->theta_r); });
  return runs;
}

/// Adds the three columns of an estimate of theta_d.
void add_estimate(std::vector<Column>& columns, const std::string& name, const std::string& meaning) {
  columns.push_back({name, "deg", "theta_d by " + meaning, {}});
  columns.push_back({name + "_low", "deg", "lower end of its range", {}});
  columns.push_back({name + "_high", "deg", "upper end of its range", {}});
}

std::vector<Column> empty_columns(std::span<const analysis::RunThreshold> thresholds) {
  std::vector<Column> columns = {
      {"seed", "1", "seed of the run", {}},
      {"theta_r", "deg", "angle at rest", {}},
      {"theta_c", "deg", "angle of repose", {}},
  };
  for (const analysis::RunThreshold& threshold : thresholds) {
    const std::string text = scenario::short_text(threshold.factor);
    add_estimate(columns, "lc_jump_" + text, fmt::format("the jump of l_c max, threshold {} Gamma_c", text));
    add_estimate(columns, "percolation_" + text,
                 fmt::format("percolation of the overloaded grains, threshold {} Gamma_c", text));
  }
  add_estimate(columns, "dilation_volume", "the onset of dilation, volume");
  add_estimate(columns, "dilation_centre", "the onset of dilation, centre of mass");
  return columns;
}

/// Returns the values of a run in the order of empty_columns. An angle that is determined from two frames
/// lies between them; it has no range if there is no earlier frame.
std::vector<double> row_of(const runs::RunView& run) {
  const analysis::Analysis& analysis = run.analysis;
  std::vector<double> row = {static_cast<double>(run.scenario.seed), degrees(run.theta_r),
                             degrees(analysis.theta_c)};
  for (const analysis::RunThreshold& threshold : analysis.thresholds)
    for (const auto& [tilt, error] : {std::pair(threshold.lc_jump, threshold.lc_jump_error),
                                      std::pair(threshold.percolation, threshold.percolation_error)}) {
      const double angle = degrees(tilt), spacing = degrees(error);
      row.insert(row.end(), {angle, std::isnan(spacing) ? angle : angle - spacing, angle});
    }
  for (std::size_t s = 0; s < 2; ++s)
    row.insert(row.end(), {degrees(analysis.dilation[s]), degrees(analysis.dilation_low[s]),
                           degrees(analysis.dilation_high[s])});
  return row;
}

std::vector<Column> columns_of(const RunChoice& runs) {
  std::vector<Column> columns = empty_columns(runs.front()->analysis.thresholds);
  for (const runs::RunView* run : runs) {
    const std::vector<double> row = row_of(*run);
    for (std::size_t k = 0; k < columns.size(); ++k) columns[k].values.push_back(row[k]);
  }
  return columns;
}

std::string factors_text(const runs::RunView& run) {
  return joined(run.analysis.thresholds, " ", [](const analysis::RunThreshold& threshold) {
    return scenario::short_text(threshold.factor);
  });
}

std::string caption_of(std::size_t runs) {
  return fmt::format(
      "Angle at rest theta_r, the dynamic angle of repose, of {}, (a) over the angle of repose theta_c and "
      "(b, c, d) over theta_d by each of its estimators; the line is theta_r = theta. (b) and (c): jump of "
      "l_c max and percolation of the overloaded grains, filled for the first threshold, open for the last; "
      "bars extend to the preceding frame. (d): onset of dilation, filled from the volume, open from the "
      "centre of mass; bars are the range in which the strain equals its minimum within the noise.",
      runs_text(runs));
}

/// Adds the flow of one run, which only its file contains.
void add_trace(Figure& figure, const runs::RunView& run, const std::string& label) {
  figure.height_over_width = 0.55;
  set_variable(figure, "flow", 1.0);
  figure.caption +=
      fmt::format(" (e) Tilt and velocity of the surface layer over the time since failure: {}, seed {}.",
                  label, run.scenario.seed);
  figure.tables.push_back(flow_trace(run));
}

/// Sets the axis limits: whole degrees, with a margin of at least one degree around all angles at rest, and
/// the upper end of the other axis beyond all theta_c.
void set_range(Figure& figure) {
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest, end = 24.0;
  for (const Table& table : figure.tables) {
    for (const double theta_c : table.columns[2].values) end = std::max(end, std::ceil(theta_c) + 1.0);
    const auto [low, high] = std::ranges::minmax(table.columns[1].values);
    lowest = std::min(lowest, low);
    highest = std::max(highest, high);
  }
  set_variable(figure, "theta_end", end);
  set_variable(figure, "lowest", std::floor(lowest) - 1.0);
  set_variable(figure, "highest", std::ceil(highest) + 1.0);
}

}  // namespace

Table flow_trace(const runs::RunView& run) {
  const RunStatics& statics = run.file->header().statics;
  const double unit = std::sqrt(statics.gravity * statics.mean_diameter);
  Table table{"trace",
              {{"time", "s", "time since failure", {}},
               {"theta", "deg", "tilt", {}},
               {"velocity", "sqrt(g D)", "mean velocity of the surface layer since the preceding row", {}}}};
  const std::vector<ObservableRow> rows = run.file->all_observables();
  const double failure = at(run.file->observables().back(), Observable::time);
  for (std::size_t k = 1; k < rows.size(); ++k) {
    const double time = at(rows[k], Observable::time);
    const double interval = time - at(rows[k - 1], Observable::time);
    if (time < failure - seconds_before_failure || interval <= 0.0) continue;
    const double moved =
        at(rows[k], Observable::surface_displacement) - at(rows[k - 1], Observable::surface_displacement);
    table.columns[0].values.push_back(time - failure);
    table.columns[1].values.push_back(degrees(at(rows[k], Observable::tilt)));
    table.columns[2].values.push_back(moved / interval / unit);
  }
  return table;
}

std::optional<Figure> dynamic_angle_figure(std::span<const RunGroup> groups) {
  Figure figure;
  figure.name = "dynamic-angle";
  figure.title = "Angle at rest against theta_c and theta_d";
  figure.wide = true;
  figure.height_over_width = 0.3;
  set_variable(figure, "flow", 0.0);
  const runs::RunView* shown = nullptr;
  std::string shown_label;
  for (const RunGroup& group : groups) {
    const RunChoice runs = runs_at_rest(group);
    if (runs.empty()) continue;
    add_group_table(figure, group, runs, columns_of(runs));
    if (figure.tables.size() == 1)
      set_variable(figure, "factors", gnuplot_string(factors_text(*runs.front())));
    const RunChoice files = with_files(runs);
    if (shown != nullptr || files.empty()) continue;
    shown = files.front();
    shown_label = group.label;
  }
  if (figure.tables.empty()) return std::nullopt;
  set_range(figure);
  figure.caption = caption_of(figure.runs.size());
  if (shown != nullptr) add_trace(figure, *shown, shown_label);
  return figure;
}

}  // namespace talus::figures
