#include "app/plot_figure.h"

#include <algorithm>
#include <fmt/core.h>

#include "figures/group_table.h"
#include "scenario/text.h"

namespace talus::app {
namespace {

/// Converts "packing/stress_ratio" to the name of a file or column.
std::string plain_name(std::string name) {
  std::ranges::replace(name, '/', '-');
  return name;
}

/// Returns the name of the quantity, or the text of a curve without a quantity.
std::string column_name(const view::PlotSeries& series) {
  return series.quantity ? series.quantity->name : series.name;
}

std::string meaning_of(const view::PlotSeries& series) {
  return series.quantity ? series.quantity->definition : series.name;
}

std::string unit_of(const view::PlotSeries& series) {
  if (!series.quantity) return "1";
  return series.quantity->display.percent ? "%" : analysis::scaled_unit(series.quantity->unit);
}

/// Returns the table with these x values, created if missing; tables are named `name`, "name-2", ...
figures::Table& table_over(const std::vector<double>& x, const view::Plot& plot, const std::string& name,
                           figures::Figure& figure, std::size_t first) {
  for (std::size_t t = first; t < figure.tables.size(); ++t)
    if (figure.tables[t].columns[0].values == x) return figure.tables[t];
  const std::size_t before = figure.tables.size() - first;
  std::string full = name;
  if (before > 0) full += fmt::format("{}{}", name.empty() ? "" : "-", before + 1);
  const std::string_view title = plot.x_title;
  const std::size_t in = title.rfind(" in ");
  const std::string unit = in == std::string_view::npos ? "1" : std::string(title.substr(in + 4));
  figure.tables.push_back({full, {{"x", unit == "°" ? "deg" : unit, std::string(title.substr(0, in)), x}}});
  return figure.tables.back();
}

void add_curve(const view::Plot& plot, const view::PlotSeries& series, figures::Figure& figure,
               std::size_t& curves) {
  figures::Table& table = table_over(series.x, plot, "", figure, 0);
  table.columns.push_back({column_name(series), unit_of(series), meaning_of(series), series.y});
  ++curves;
  figure.variables.emplace_back(fmt::format("file_{}", curves),
                                figures::gnuplot_string(figures::file_of(figure, table)));
  figure.variables.emplace_back(fmt::format("column_{}", curves), fmt::format("{}", table.columns.size()));
  figure.variables.emplace_back(fmt::format("title_{}", curves), figures::gnuplot_string(series.name));
  figure.variables.emplace_back(fmt::format("law_{}", curves), series.law ? "1" : "0");
}

void add_ghost(const view::Plot& plot, const view::PlotSeries& series, std::size_t first, std::size_t curve,
               figures::Figure& figure, std::size_t& behinds) {
  figures::Table& table = table_over(series.behind.x, plot, "behind", figure, first);
  const std::string name = column_name(series), what = "behind: " + meaning_of(series);
  table.columns.push_back({name, unit_of(series), what + ", mean of the runs", series.behind.mean});
  table.columns.push_back(
      {name + "_deviation", unit_of(series), what + ", standard deviation", series.behind.deviation});
  ++behinds;
  figure.variables.emplace_back(fmt::format("behind_file_{}", behinds),
                                figures::gnuplot_string(figures::file_of(figure, table)));
  figure.variables.emplace_back(fmt::format("behind_column_{}", behinds),
                                fmt::format("{}", table.columns.size() - 1));
  figure.variables.emplace_back(fmt::format("behind_curve_{}", behinds), fmt::format("{}", curve));
}

}  // namespace

figures::Figure plot_figure(const view::Plot& plot, const view::PlotOptions& options,
                            const view::PlotMarks& marks, const std::string& run, const std::string& behind) {
  figures::Figure figure;
  figure.name = "plot-" + plain_name(plot.name);
  figure.script = "plot";
  figure.title = plot.title;
  figure.caption = plot.title + " over " + plot.x_title;
  if (!plot.note.empty()) figure.caption += ", " + plot.note;
  if (!run.empty()) figure.runs.push_back(run);
  std::size_t curves = 0, behinds = 0;
  for (const view::PlotSeries& series : plot.series)
    if (!series.x.empty()) add_curve(plot, series, figure, curves);
  const std::size_t first = figure.tables.size();
  for (std::size_t k = 0; k < plot.series.size(); ++k)
    if (!plot.series[k].behind.x.empty() && !plot.series[k].x.empty())
      add_ghost(plot, plot.series[k], first, k + 1, figure, behinds);
  if (behinds > 0) figure.caption += "; behind: " + behind;
  const auto set = [&figure](const std::string& name, const std::string& value) {
    figure.variables.emplace_back(name, value);
  };
  set("plotted", fmt::format("{}", curves));
  set("behinds", fmt::format("{}", behinds));
  set("behind_title", figures::gnuplot_quoted(behind));
  set("x_title_of_plot", figures::gnuplot_string(plot.x_title));
  set("y_title_of_plot", figures::gnuplot_string(plot.title));
  set("note", figures::gnuplot_string(plot.note));
  set("logarithmic", options.log_y.value_or(plot.log_y) ? "1" : "0");
  set("falling", plot.falling_x ? "1" : "0");
  if (options.zoomed) {
    set("x_low", scenario::short_text((*options.zoomed)[0]));
    set("x_high", scenario::short_text((*options.zoomed)[1]));
  }
  if (marks.theta_c && plot.along_run) set("theta_c_at", scenario::short_text(*marks.theta_c));
  return figure;
}

}  // namespace talus::app
