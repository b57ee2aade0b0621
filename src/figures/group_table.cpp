#include "figures/group_table.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fmt/core.h>

#include "figures/run_means.h"
#include "runs/analysis_parameters.h"
#include "scenario/text.h"

namespace talus::figures {
namespace {

constexpr std::size_t symbols_of_a_curve = 16;

template <typename Condition>
RunChoice choose(const RunGroup& group, const Condition& condition) {
  RunChoice choice;
  for (const runs::RunView& run : group.runs)
    if (condition(run)) choice.push_back(&run);
  return choice;
}

/// Returns the largest tilt, or angle left to failure, in tables whose first column is such an angle, deg; 1
/// if all are 0 because an axis needs a length.
double largest_tilt(const Figure& figure) {
  double largest = 0.0;
  for (const Table& table : figure.tables)
    if (const Column& first = table.columns.front(); first.name == "theta" || first.name == "angle_left")
      for (const double tilt : first.values) largest = std::max(largest, tilt);
  return largest > 0.0 ? largest : 1.0;
}

}  // namespace

RunChoice all_runs(const RunGroup& group) {
  return choose(group, [](const runs::RunView&) { return true; });
}

RunChoice runs_with_threshold(const RunGroup& group) {
  return choose(group, [](const runs::RunView& run) { return !run.analysis.thresholds.empty(); });
}

RunChoice failed_runs(const RunGroup& group) {
  return choose(group, [](const runs::RunView& run) { return !std::isnan(theta_c_of(run)); });
}

RunChoice with_files(RunChoice runs) {
  std::erase_if(runs, [](const runs::RunView* run) { return !run->file; });
  return runs;
}

RunChoice with_frames(RunChoice runs) {
  std::erase_if(runs, [](const runs::RunView* run) { return !run->file || !run->file->has_frames(); });
  return runs;
}

RunChoice with_distributions(RunChoice runs) {
  std::erase_if(runs, [](const runs::RunView* run) { return run->analysis.gamma_edge.empty(); });
  return runs;
}

FramesAtAngle frames_at_angle(const RunChoice& runs, double tilt) {
  FramesAtAngle result;
  for (const runs::RunView* run : runs)
    if (has_frame_near(*run, tilt)) {
      result.runs.push_back(run);
      result.frames.push_back(frame_nearest(*run, tilt));
    }
  return result;
}

std::string reading_caption(const runs::RunView& run) {
  const double l_min = runs::from_facts(run.analysis.parameters).l_min;
  if (l_min == 0.0) return "gamma is that of single grains.";
  const std::string who = l_min == analysis::default_l_min ? "its first neighbours" : "its neighbours";
  return fmt::format(
      "gamma of a grain is that of the grain together with {}, a neighbourhood of diameter {} D.", who,
      scenario::short_text(l_min));
}

void set_variable(Figure& figure, const std::string& name, const std::string& value) {
  const auto found = std::ranges::find(figure.variables, name, &std::pair<std::string, std::string>::first);
  if (found != figure.variables.end())
    found->second = value;
  else
    figure.variables.emplace_back(name, value);
}

void set_variable(Figure& figure, const std::string& name, double value) {
  set_variable(figure, name, std::isnan(value) ? "NaN" : scenario::short_text(value));
}

std::string gnuplot_quoted(std::string_view text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (std::string_view("_^{}@&~\\").find(c) != std::string_view::npos) quoted += '\\';
    if (c == '\'') quoted += '\'';
    quoted += c;
  }
  return quoted + "'";
}

std::string gnuplot_string(std::string_view text) { return fmt::format("\"{}\"", text); }

std::string runs_text(std::size_t count) { return fmt::format("{} run{}", count, count == 1 ? "" : "s"); }

// For example "pbc-l-200-d-deposition.friction-0.15" for "PBC, L = 200 D, deposition.friction = 0.15".
std::string table_name(const RunGroup& group) {
  std::string part;
  for (const char c : group.label) {
    const bool kept = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '_';
    if (kept) part += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (!kept && !part.empty() && part.back() != '-') part += '-';
  }
  return part;
}

void add_group_table(Figure& figure, const RunGroup& group, const RunChoice& runs,
                     std::vector<Column> columns) {
  const std::size_t rows = columns.front().values.size();
  figure.tables.push_back({table_name(group), std::move(columns)});
  for (const runs::RunView* run : runs) figure.runs.push_back(run->path);
  const std::string g = std::to_string(++figure.groups);
  set_variable(figure, "groups", static_cast<double>(figure.groups));
  set_variable(figure, "data_" + g, gnuplot_string(file_of(figure, figure.tables.back())));
  set_variable(figure, "label_" + g,
               gnuplot_quoted(fmt::format("{} ({})", group.label, runs_text(runs.size()))));
  set_variable(figure, "every_" + g,
               static_cast<double>(std::max<std::size_t>(1, rows / symbols_of_a_curve)));
  set_variable(figure, "theta_max", largest_tilt(figure));
}

void add_group_curves(Figure& figure, const RunGroup& group, const RunChoice& runs,
                      std::span<const FrameColumn> columns, Abscissa abscissa) {
  add_group_table(figure, group, runs, means_over_runs(runs, columns, abscissa));
  if (runs.size() > 1) {
    set_variable(figure, "spread", 1.0);
    figure.tables.push_back(
        {fmt::format("{}-runs", table_name(group)), individual_runs(runs, columns, abscissa), true});
    set_variable(figure, fmt::format("drawn_{}", figure.groups),
                 static_cast<double>(std::min(runs.size(), max_runs_drawn)));
    set_variable(figure, fmt::format("runs_{}", figure.groups),
                 gnuplot_string(file_of(figure, figure.tables.back())));
  }
}

}  // namespace talus::figures
