#include "app/figure_text.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "app/json.h"
#include "base/hash.h"
#include "base/text.h"
#include "base/version.h"
#include "figures/scripts.h"
#include "scenario/text.h"

namespace talus::app {
namespace {

/// Scripts common to all figures, in the order of their dependence.
constexpr std::string_view common_scripts[] = {"style", "text", "axes", "key", "maps"};

Json table_json(const figures::Figure& figure, const figures::Table& table) {
  Json columns = Json::array();
  for (const figures::Column& column : table.columns)
    columns.push_back({{"name", column.name}, {"unit", column.unit}, {"meaning", column.meaning}});
  return {{"file", figures::file_of(figure, table)}, {"columns", columns}};
}

Json run_json(const runs::RunView& run, const std::string& group) {
  const std::string& scenario = run.scenario_text;
  return {{"path", run.path},
          {"group", group},
          {"seed", run.scenario.seed},
          {"state_hash", run.state_hash},
          {"scenario_hash", hash_text(hash_bytes(std::as_bytes(std::span(scenario))))},
          {"analysis_key", run.analysis.key},
          {"analysis", object_of(run.analysis.parameters)}};
}

}  // namespace

std::string csv_text(const figures::Table& table) {
  std::string text = joined(table.columns, ",", &figures::Column::name) + "\n";
  const std::size_t rows = table.columns.empty() ? 0 : table.columns.front().values.size();
  for (std::size_t r = 0; r < rows; ++r) {
    const std::vector<double>& first = table.columns.front().values;
    if (table.in_blocks && r > 0 && first[r] != first[r - 1]) text += '\n';
    for (const figures::Column& column : table.columns) {
      const double value = column.values[r];
      text += std::isnan(value) ? std::string("NaN") : scenario::short_text(value);
      text += &column == &table.columns.back() ? '\n' : ',';
    }
  }
  return text;
}

std::string provenance_json(const figures::Figure& figure, std::span<const figures::RunGroup> groups,
                            const std::string& command_line) {
  Json runs = Json::array(), tables = Json::array();
  for (const figures::RunGroup& group : groups)
    for (const runs::RunView& run : group.runs)
      if (std::ranges::find(figure.runs, run.path) != figure.runs.end())
        runs.push_back(run_json(run, group.label));
  for (const figures::Table& table : figure.tables) tables.push_back(table_json(figure, table));
  return json_text({{"figure", figure.name},
                    {"title", figure.title},
                    {"caption", figure.caption},
                    {"version", version_text()},
                    {"command", command_line},
                    {"runs", runs},
                    {"tables", tables}}) +
         "\n";
}

double figure_width(const figures::Figure& figure, const FigureSize& size) {
  return size.width > 0.0 ? size.width : column_widths[figure.wide ? 1 : 0];
}

std::string gnuplot_text(const figures::Figure& figure, const FigureSize& size) {
  const double width = figure_width(figure, size);
  std::string text = fmt::format(
      "# {0}\n# To draw it again as PDF, SVG and PNG: gnuplot {1}.gp\n\nfigure = \"{1}\"\nwidth = {2}  # "
      "cm\nheight = {3}\nasked_height = {4}  # cm; 0: as high as its panels require\n",
      figure.title, figure.name, scenario::short_text(width),
      scenario::short_text(width * figure.height_over_width), scenario::short_text(size.height));
  for (const auto& [name, value] : figure.variables) text += fmt::format("{} = {}\n", name, value);
  for (const std::string_view part : common_scripts)
    text += fmt::format("\n{}", figures::figure_script(part));
  return fmt::format("{}\n{}\nunset output\npass = pass + 1\nif (pass <= 3) load figure . \".gp\"\n", text,
                     figures::figure_script(figure.script.empty() ? figure.name : figure.script));
}

}  // namespace talus::app
