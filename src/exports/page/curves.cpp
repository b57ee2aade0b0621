#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>
#include <optional>

#include "analysis/quantities.h"
#include "core/trigonometry.h"
#include "exports/page/page_data.h"
#include "runs/event_catalogue.h"
#include "session/command.h"
#include "view/frame_values.h"
#include "view/timeline.h"

namespace talus::exports {
namespace {

constexpr std::size_t max_rows = 1000;  // rows of a curve: about the number of pixels

/// Returns every row, or an even selection of about as many as there are pixels.
std::vector<ObservableRow> shown_rows(const io::RunFile& file) {
  std::vector<ObservableRow> rows = file.observables(), shown;
  const std::size_t together = (rows.size() + max_rows - 1) / max_rows;
  for (std::size_t k = 0; k < rows.size(); k += together) shown.push_back(rows[k]);
  return shown;
}

Json curve_json(const std::string& label, const char* over, const std::vector<double>& values) {
  return {{"label", label}, {"over", over}, {"values", rounded(values, "{:.5g}")}};
}

/// Returns the curve of a quantity or, if it depends on a threshold, one for each, with a rich label.
Json curves_of(const analysis::Quantity& quantity, const PageRun& run, std::span<const ObservableRow> rows) {
  const auto shown = [&](double value) {
    return analysis::shown(quantity, value, run.statics().mean_diameter);
  };
  std::vector<double> values;
  if (quantity.display.observable) {
    for (const ObservableRow& row : rows) values.push_back(shown(at(row, *quantity.display.observable)));
    return Json::array({curve_json("", "rows", values)});
  }
  const bool by_threshold = analysis::needs_threshold(quantity);
  Json curves = Json::array();
  for (std::size_t f = 0; f < (by_threshold ? run.analysis.thresholds.size() : 1); ++f) {
    const double factor = by_threshold ? run.analysis.thresholds[f].factor : 1.0;
    values.clear();
    for (const analysis::FrameRecord& frame : run.analysis.frames)
      values.push_back(shown(analysis::number_of(quantity, frame, f)));
    curves.push_back(curve_json(!by_threshold   ? ""
                                : factor == 1.0 ? "at Γ_c"
                                                : fmt::format("at {:.6g} Γ_c", factor),
                                "frames", values));
  }
  return curves;
}

bool has_value(const Json& curve) {
  return std::any_of(curve["values"].begin(), curve["values"].end(),
                     [](const Json& value) { return value.is_number(); });
}

/// Returns the title used for curves, or name and unit of a quantity without a symbol.
std::string title_of(const analysis::Quantity& quantity) {
  if (!quantity.display.symbol.empty()) return analysis::shown_title(quantity);
  return analysis::axis_title(quantity.name, analysis::scaled_unit(quantity.unit));
}

/// Names of the kinds of events, in the order of view::TimelineEvent::Kind.
constexpr std::array<const char*, 4> kind_names = {"transition", "failure", "command", "rearrangement"};

}  // namespace

Json curves_json(const PageRun& run) {
  const std::vector<ObservableRow> rows = shown_rows(run.file);
  std::vector<double> row_tilts, row_places, frame_places;
  for (const ObservableRow& row : rows) {
    row_tilts.push_back(degrees(at(row, Observable::tilt)));
    row_places.push_back(run.place(at(row, Observable::tilt), at(row, Observable::time)));
  }
  for (std::size_t k = 0; k < run.file.frame_count(); ++k) frame_places.push_back(run.place(k));
  Json quantities = Json::array();
  for (const analysis::Quantity& quantity : analysis::quantities()) {
    if (!analysis::is_number_of_frame(quantity)) continue;
    const Json curves = curves_of(quantity, run, rows);
    if (std::any_of(curves.begin(), curves.end(), has_value))
      quantities.push_back({{"name", quantity.name},
                            {"title", title_of(quantity)},
                            {"common", !quantity.display.symbol.empty()},
                            {"definition", quantity.definition},
                            {"curves", curves}});
  }
  return {{"rows", rounded(row_places, "{:.6g}")},
          {"tilts", rounded(row_tilts, "{:.6g}")},
          {"frames", rounded(frame_places, "{:.6g}")},
          {"quantities", quantities}};
}

Json events_json(const PageRun& run) {
  const std::vector<Command> commands = session::given_commands(run.file.commands());
  const std::vector<ObservableRow> rows = run.file.observables();
  const std::vector<analysis::FrameRecord> values =
      run.has_threshold() ? view::stored_records(run.analysis, 0) : std::vector<analysis::FrameRecord>();
  view::TimelineSource source;
  source.tilts = run.file.frame_tilts();
  source.times = run.file.all_frame_times();
  source.rows = rows;
  source.values = values;
  source.commands = commands;
  const World& end = run.file.checkpoint().world;
  const std::vector<ObservableRow> command_rows =
      session::rows_up_to(run.file.all_observables(), end.step, end.time, end.tilt);
  source.command_rows = command_rows;
  source.rearrangements = run.analysis.events;
  source.energy_unit =
      runs::mean_grain_mass(run.statics()) * run.statics().gravity * run.statics().mean_diameter;
  if (std::isfinite(run.analysis.theta_c)) source.theta_c = run.analysis.theta_c;
  source.mean_diameter = run.statics().mean_diameter;
  source.cut = run.analysis.lc_cut;
  source.may_change = !run.file.complete();
  std::vector<double> places;  // of the page's frames that belong to the tilt
  for (const std::size_t k : run.frames)
    if (k < run.file.frame_count()) places.push_back(run.place(k));
  Json events = Json::array();
  for (const view::TimelineEvent& event : view::timeline_events(source)) {
    // An event outside the range of the page's frames cannot be placed; theta_c may lie just after the last.
    const double at = run.place(event.tilt, event.time);
    const double spacing = source.tilts.size() > 1 ? run.place(1) - run.place(0) : 0.0;
    if (places.empty() || at < places.front() - spacing || at > places.back() + spacing) continue;
    events.push_back({{"name", event.name},
                      {"label", event.label},
                      {"what", event.what},
                      {"kind", kind_names.at(static_cast<std::size_t>(event.kind))},
                      {"size", rounded(event.size, "{:.3f}")},
                      {"tilt", rounded(degrees(event.tilt), "{:.4f}")},
                      {"at", rounded(at, "{:.8g}")},
                      {"place", rounded(view::place_among(places, at), "{:.4f}")}});
  }
  return events;
}

}  // namespace talus::exports
