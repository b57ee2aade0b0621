#include "app/plot_export.h"

#include "analysis/quantities.h"

namespace talus::app {
namespace {

std::string unit_of(const view::PlotSeries& series) {
  if (!series.quantity) return "1";
  return series.quantity->display.percent ? "%" : analysis::scaled_unit(series.quantity->unit);
}

Json series_json(const view::PlotSeries& series) {
  return {{"label", series.name},
          {"column", series.quantity ? series.quantity->name : series.name},
          {"unit", unit_of(series)},
          {"meaning", series.quantity ? series.quantity->definition : series.name},
          {"law", series.law},
          {"x", series.x},
          {"y", series.y}};
}

}  // namespace

Json plot_json(const view::Plot& plot, const view::PlotOptions& options, const view::PlotMarks& marks,
               const std::string& run) {
  Json json = {
      {"name", plot.name},         {"title", plot.title}, {"x_title", plot.x_title},
      {"note", plot.note},         {"run", run},          {"logarithmic", options.log_y.value_or(plot.log_y)},
      {"falling", plot.falling_x}, {"range", nullptr},    {"theta_c", nullptr},
      {"series", Json::array()}};
  if (options.zoomed) json["range"] = *options.zoomed;
  if (marks.theta_c && plot.along_run) json["theta_c"] = *marks.theta_c;
  for (const view::PlotSeries& series : plot.series)
    if (!series.x.empty()) json["series"].push_back(series_json(series));
  return json;
}

}  // namespace talus::app
