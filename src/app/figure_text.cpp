#include "app/figure_text.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "core/hash.h"
#include "core/text.h"
#include "core/version.h"
#include "figures/scripts.h"
#include "scenario/json.h"

namespace talus {
namespace {

using json::quoted;

/// What the scripts of all figures share, in the order in which one builds on the other.
constexpr std::string_view common_scripts[] = {"style", "text", "axes", "key", "maps"};

std::string list_of(const std::vector<std::string>& values, int depth) {
  const std::string margin(2 * static_cast<std::size_t>(depth), ' ');
  std::string text = "[";
  for (const std::string& value : values)
    text += fmt::format("{}{}  {}", text.size() > 1 ? ",\n" : "\n", margin, value);
  return values.empty() ? "[]" : fmt::format("{}\n{}]", text, margin);
}

std::string table_json(const Figure& figure, const Table& table) {
  std::vector<std::string> columns;
  for (const Column& column : table.columns)
    columns.push_back(json::object(
        {{"name", quoted(column.name)}, {"unit", quoted(column.unit)}, {"meaning", quoted(column.meaning)}},
        4));
  return json::object({{"file", quoted(file_of(figure, table))}, {"columns", list_of(columns, 3)}}, 2);
}

std::string run_json(const RunView& run, const std::string& group) {
  const std::string& scenario = run.scenario_text;
  json::Members parameters;
  for (const auto& [name, value] : run.analysis.parameters) parameters.emplace_back(name, quoted(value));
  return json::object({{"path", quoted(run.path)},
                       {"group", quoted(group)},
                       {"seed", json::number(run.scenario.seed)},
                       {"state_hash", quoted(run.state_hash)},
                       {"scenario_hash", quoted(hash_text(hash_bytes(std::as_bytes(std::span(scenario)))))},
                       {"analysis_key", quoted(run.analysis.key)},
                       {"analysis", json::object(parameters, 3)}},
                      2);
}

}  // namespace

std::string csv_text(const Table& table) {
  std::string text = joined(table.columns, ",", &Column::name) + "\n";
  const std::size_t rows = table.columns.empty() ? 0 : table.columns.front().values.size();
  for (std::size_t r = 0; r < rows; ++r) {
    const std::vector<double>& first = table.columns.front().values;
    if (table.in_blocks && r > 0 && first[r] != first[r - 1]) text += '\n';
    for (const Column& column : table.columns) {
      const double value = column.values[r];
      text += std::isnan(value) ? std::string("NaN") : short_text(value);
      text += &column == &table.columns.back() ? '\n' : ',';
    }
  }
  return text;
}

std::string provenance_json(const Figure& figure, std::span<const RunGroup> groups,
                            const std::string& command_line) {
  std::vector<std::string> runs, tables;
  for (const RunGroup& group : groups)
    for (const RunView& run : group.runs)
      if (std::ranges::find(figure.runs, run.path) != figure.runs.end())
        runs.push_back(run_json(run, group.label));
  for (const Table& table : figure.tables) tables.push_back(table_json(figure, table));
  return json::object({{"figure", quoted(figure.name)},
                       {"title", quoted(figure.title)},
                       {"caption", quoted(figure.caption)},
                       {"version", quoted(version_text())},
                       {"command", quoted(command_line)},
                       {"runs", list_of(runs, 1)},
                       {"tables", list_of(tables, 1)}}) +
         "\n";
}

double figure_width(const Figure& figure, int columns) {
  return column_widths[columns > 0 ? columns - 1 : figure.wide ? 1 : 0];
}

std::string gnuplot_text(const Figure& figure, double width) {
  std::string text = fmt::format(
      "# {0}\n# To draw it again as PDF, SVG and PNG: gnuplot {1}.gp\n\nfigure = \"{1}\"\nwidth = {2}  # "
      "cm\nheight = {3}\n",
      figure.title, figure.name, short_text(width), short_text(width * figure.height_over_width));
  for (const auto& [name, value] : figure.variables) text += fmt::format("{} = {}\n", name, value);
  for (const std::string_view part : common_scripts) text += fmt::format("\n{}", figure_script(part));
  return fmt::format("{}\n{}\nunset output\npass = pass + 1\nif (pass <= 3) reread\n", text,
                     figure_script(figure.script.empty() ? figure.name : figure.script));
}

}  // namespace talus
