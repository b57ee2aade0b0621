#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <functional>
#include <string>

#include "analysis/quantities.h"
#include "core/statistics.h"
#include "core/trigonometry.h"
#include "figures/failed_group.h"
#include "figures/group_table.h"
#include "figures/recipes.h"
#include "figures/run_means.h"

namespace talus::figures {
namespace {

/// Returns the number of frames shown: those of the entire tilt, or those before failure.
std::size_t frames_shown(const runs::RunView& run) {
  return std::isnan(theta_c_of(run)) ? run.analysis.frames.size() : repose_frame(run) + 1;
}

std::vector<TiltCycle> cycles_of_run(const runs::RunView& run) {
  std::vector<double> tilts;
  for (std::size_t k = 0; k < frames_shown(run); ++k) tilts.push_back(run.analysis.frames[k].tilt);
  return cycles_of(tilts);
}

bool has_overload(const runs::RunView& run) { return !run.analysis.thresholds.empty(); }

/// Returns the quantities drawn over the tilt and at the ends of cycles.
std::vector<FrameColumn> columns_over_tilt(const runs::RunView& run) {
  std::vector<FrameColumn> columns = {
      column_of("volume_strain", analysis::quantity_of(&analysis::FrameRecord::volume_strain)),
      column_of("coordination", analysis::quantity_of(&analysis::FrameRecord::coordination_number)),
      column_of("critical", analysis::quantity_of(&analysis::FrameRecord::critical_share)),
      {"anisotropy", "1", analysis::quantity_of(&analysis::FrameRecord::fabric_amplitude).definition,
       [](const runs::RunView& run_view, std::size_t frame) {
         return run_view.analysis.frames.at(frame).fabric_amplitude[0];
       }},
  };
  columns.push_back(
      has_overload(run)
          ? column_of("overloaded", analysis::quantity_of(&analysis::FrameThreshold::overloaded_fraction))
          : column_of("stress_ratio", analysis::quantity_of(&analysis::FrameRecord::stress_ratio)));
  return columns;
}

/// Returns a row for each frame with the number of its cycle; the last frame of a cycle is the first of the
/// next.
Table loops(const runs::RunView& run) {
  const std::vector<FrameColumn> shown_columns_of_run = columns_over_tilt(run);
  Table table{"",
              {{"cycle", "1", "number of the cycle, from 1", {}},
               {"time", "s", "time since the tilt began", {}},
               {"theta", "deg", "tilt", {}}},
              true};
  for (const FrameColumn& column : shown_columns_of_run)
    table.columns.push_back({column.name, column.unit, column.meaning, {}});
  const std::vector<double>& times = run.file->all_frame_times();
  const std::vector<TiltCycle> cycles = cycles_of_run(run);
  for (std::size_t c = 0; c < cycles.size(); ++c)
    for (std::size_t k = cycles[c].first; k <= cycles[c].last; ++k) {
      table.columns[0].values.push_back(static_cast<double>(c + 1));
      table.columns[1].values.push_back(times[k] - times.front());
      table.columns[2].values.push_back(degrees(run.analysis.frames[k].tilt));
      for (std::size_t q = 0; q < shown_columns_of_run.size(); ++q)
        table.columns[3 + q].values.push_back(shown_columns_of_run[q].value(run, k));
    }
  return table;
}

/// Returns a row for each cycle completed by all runs, and row 0 for the bed before the first cycle: means
/// over the runs at the end and at the top of the cycle, with their standard errors.
Table ends_of_cycles(const RunChoice& runs) {
  std::vector<std::vector<TiltCycle>> cycles;
  std::size_t count = 0;
  for (const runs::RunView* run : runs) {
    cycles.push_back(cycles_of_run(*run));
    std::erase_if(cycles.back(), [](const TiltCycle& cycle) { return !cycle.is_closed; });
    count = cycles.size() == 1 ? cycles.back().size() : std::min(count, cycles.back().size());
  }
  Table table{"ends",
              {{"cycle", "1", "number of the cycle; 0: the bed before the first", {}},
               {"n", "1", "number of runs in the row", {}}}};
  const auto add = [&](const FrameColumn& column, const std::string& where, const std::string& meaning,
                       const std::function<std::size_t(const TiltCycle&)>& frame_of) {
    Column mean{column.name + where, column.unit, meaning + ": " + column.meaning, {}};
    Column error{mean.name + "_error", column.unit, "its standard error over the runs", {}};
    for (std::size_t c = 0; c <= count; ++c) {
      std::vector<double> values;
      for (std::size_t r = 0; r < runs.size(); ++r)
        values.push_back(c == 0 && where == "_top"
                             ? not_known
                             : column.value(*runs[r], c == 0 ? 0 : frame_of(cycles[r][c - 1])));
      const Statistics result = statistics_of(values);
      mean.values.push_back(result.mean);
      error.values.push_back(result.error);
    }
    table.columns.push_back(std::move(mean));
    table.columns.push_back(std::move(error));
  };
  for (const FrameColumn& column : columns_over_tilt(*runs.front())) {
    add(column, "_end", "at the end of the cycle", [](const TiltCycle& cycle) { return cycle.last; });
    add(column, "_top", "at its highest tilt", [](const TiltCycle& cycle) { return cycle.top; });
  }
  for (std::size_t c = 0; c <= count; ++c) {
    table.columns[0].values.push_back(static_cast<double>(c));
    table.columns[1].values.push_back(static_cast<double>(runs.size()));
  }
  return table;
}

/// Returns the runs whose tilt returns at least once before failure.
RunChoice runs_with_returns(const RunGroup& group) {
  RunChoice runs = with_files(all_runs(group));
  std::erase_if(runs,
                [](const runs::RunView* run) { return std::ranges::is_sorted(run->file->frame_tilts()); });
  return runs;
}

std::string caption_of(const RunGroup& group, const RunChoice& runs) {
  const runs::RunView& first = *runs.front();
  std::string text = fmt::format(
      "A bed whose tilt goes up and down: {}, seed {}. (a) Tilt over time. Over the tilt, with a "
      "different colour for each cycle: (b) volume strain since the start of the tilt, (c) coordination "
      "number z, (d) share of the contacts with fully mobilised friction nu, (e) {}, (f) amplitude of the "
      "anisotropy of the contacts. ",
      group.label, first.scenario.seed,
      has_overload(first) ? "overloaded fraction p_o" : "stress ratio of the packing Gamma");
  if (!std::isnan(theta_c_of(first))) text += "The last cycle ends before failure. ";
  text += fmt::format(
      "(g, h, i) Accumulation over cycles: volume strain, z and nu at the end of each completed cycle "
      "(filled; 0: before the first) and at its highest tilt (open), for {}",
      runs_text(runs.size()));
  return text + (runs.size() > 1 ? ", mean and standard error." : ".");
}

}  // namespace

std::vector<TiltCycle> cycles_of(std::span<const double> tilts) {
  std::vector<TiltCycle> cycles;
  if (tilts.empty()) return cycles;
  TiltCycle cycle;
  bool fallen = false;
  for (std::size_t k = 1; k < tilts.size(); ++k) {
    if (tilts[k] > tilts[k - 1] && fallen) {
      cycle.last = k - 1;
      cycle.is_closed = true;
      cycles.push_back(cycle);
      cycle = {k - 1, k - 1, k - 1, false};
      fallen = false;
    }
    fallen = fallen || tilts[k] < tilts[k - 1];
    if (tilts[k] >= tilts[cycle.top]) cycle.top = k;
  }
  cycle.last = tilts.size() - 1;
  cycle.is_closed = fallen;
  cycles.push_back(cycle);
  return cycles;
}

std::optional<Figure> cycles_figure(std::span<const RunGroup> groups) {
  for (const RunGroup& group : groups) {
    const RunChoice runs = runs_with_returns(group);
    if (runs.empty()) continue;
    Figure figure;
    figure.name = "cycles";
    figure.title = "Cycles of the tilt, and what accumulates over them";
    figure.caption = caption_of(group, runs);
    for (const runs::RunView* run : runs) figure.runs.push_back(run->path);
    figure.wide = true;
    figure.height_over_width = 0.83;
    figure.tables = {loops(*runs.front()), ends_of_cycles(runs)};
    const std::vector<double>& numbers = figure.tables.front().columns.front().values;
    set_variable(figure, "cycles", numbers.empty() ? 1.0 : numbers.back());
    set_variable(figure, "closed", figure.tables.back().columns.front().values.back());
    set_variable(figure, "has_overload", has_overload(*runs.front()) ? 1.0 : 0.0);
    return figure;
  }
  return std::nullopt;
}

}  // namespace talus::figures
