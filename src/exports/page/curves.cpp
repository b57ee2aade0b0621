#include "exports/page/curves.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <optional>

#include "analysis/quantities.h"
#include "core/trigonometry.h"
#include "exports/page/json.h"
#include "runs/event_catalogue.h"
#include "session/command.h"
#include "view/frame_values.h"
#include "view/timeline.h"

namespace talus::exports {
namespace {

constexpr int digits = 5;
constexpr std::size_t max_rows = 1000;  // rows of a curve: about the number of pixels

struct PageCurve {
  std::string label;  ///< rich text, empty if there is only one curve
  bool recorded = false;
  std::vector<double> values;
};

/// Returns every row, or an even selection of about as many as there are pixels.
std::vector<ObservableRow> shown_rows(const io::RunFile& file) {
  std::vector<ObservableRow> rows = file.observables(), shown;
  const std::size_t together = (rows.size() + max_rows - 1) / max_rows;
  for (std::size_t k = 0; k < rows.size(); k += together) shown.push_back(rows[k]);
  return shown;
}

PageCurve recorded_curve(const analysis::Quantity& quantity, std::span<const ObservableRow> rows,
                         double diameter) {
  PageCurve curve{"", true, {}};
  for (const ObservableRow& row : rows)
    curve.values.push_back(analysis::shown(quantity, at(row, *quantity.display.observable), diameter));
  return curve;
}

PageCurve curve_of_frames(const analysis::Quantity& quantity, const PageRun& run, std::size_t f) {
  PageCurve curve;
  for (const analysis::FrameRecord& frame : run.analysis.frames)
    curve.values.push_back(
        analysis::shown(quantity, analysis::number_of(quantity, frame, f), run.statics().mean_diameter));
  return curve;
}

std::string threshold_label(double factor) {
  return factor == 1.0 ? "at Γ_c" : fmt::format("at {:.6g} Γ_c", factor);
}

std::vector<PageCurve> curves_of(const analysis::Quantity& quantity, const PageRun& run,
                                 std::span<const ObservableRow> rows) {
  if (quantity.display.observable) return {recorded_curve(quantity, rows, run.statics().mean_diameter)};
  if (!analysis::needs_threshold(quantity)) return {curve_of_frames(quantity, run, 0)};
  std::vector<PageCurve> curves;
  for (std::size_t f = 0; f < run.analysis.thresholds.size(); ++f) {
    curves.push_back(curve_of_frames(quantity, run, f));
    curves.back().label = threshold_label(run.analysis.thresholds[f].factor);
  }
  return curves;
}

bool has_value(const PageCurve& curve) {
  return std::ranges::any_of(curve.values, [](double value) { return std::isfinite(value); });
}

std::string curve_json(const PageCurve& curve) {
  return json::line({{"label", json::quoted(curve.label)},
                     {"over", json::quoted(curve.recorded ? "rows" : "frames")},
                     {"values", json::rounded(curve.values, digits)}});
}

/// Returns the title used for curves, or name and unit of a quantity without a symbol.
std::string title_of(const analysis::Quantity& quantity) {
  if (!quantity.display.symbol.empty()) return analysis::shown_title(quantity);
  return analysis::axis_title(quantity.name, analysis::scaled_unit(quantity.unit));
}

std::string quantity_json(const analysis::Quantity& quantity, const std::vector<PageCurve>& curves) {
  std::vector<std::string> texts;
  for (const PageCurve& curve : curves) texts.push_back(curve_json(curve));
  return json::line({{"name", json::quoted(quantity.name)},
                     {"title", json::quoted(title_of(quantity))},
                     {"common", json::truth(!quantity.display.symbol.empty())},
                     {"definition", json::quoted(quantity.definition)},
                     {"curves", json::list(texts)}});
}

std::string kind_text(view::TimelineEvent::Kind kind) {
  switch (kind) {
    case view::TimelineEvent::Kind::failure:
      return "failure";
    case view::TimelineEvent::Kind::command:
      return "command";
    case view::TimelineEvent::Kind::rearrangement:
      return "rearrangement";
    case view::TimelineEvent::Kind::transition:
      break;
  }
  return "transition";
}

/// Returns the tilts of the page's frames that belong to the tilt.
std::vector<double> tilts_on_page(const PageRun& run) {
  std::vector<double> tilts;
  for (const std::size_t k : run.frames)
    if (k < run.file.frame_count()) tilts.push_back(run.file.frame_tilts()[k]);
  return tilts;
}

}  // namespace

std::string curves_json(const PageRun& run) {
  const std::vector<ObservableRow> rows = shown_rows(run.file);
  std::vector<double> row_tilts, frame_tilts;
  for (const ObservableRow& row : rows) row_tilts.push_back(degrees(at(row, Observable::tilt)));
  for (const double tilt : run.file.frame_tilts()) frame_tilts.push_back(degrees(tilt));
  std::vector<std::string> texts;
  for (const analysis::Quantity& quantity : analysis::quantities()) {
    if (!analysis::is_number_of_frame(quantity)) continue;
    const std::vector<PageCurve> curves = curves_of(quantity, run, rows);
    if (std::ranges::any_of(curves, has_value)) texts.push_back(quantity_json(quantity, curves));
  }
  return json::line({{"rows", json::rounded(row_tilts, 6)},
                     {"frames", json::rounded(frame_tilts, 6)},
                     {"quantities", json::list(texts)}});
}

std::string events_json(const PageRun& run) {
  const std::vector<Command> commands = session::given_commands(run.file.commands());
  const std::vector<ObservableRow> rows = run.file.observables();
  const std::vector<analysis::FrameRecord> values =
      run.has_threshold() ? view::stored_records(run.analysis, 0) : std::vector<analysis::FrameRecord>();
  view::TimelineSource source;
  source.tilts = run.file.frame_tilts();
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
  const std::vector<double> tilts = tilts_on_page(run);
  std::vector<std::string> texts;
  for (const view::TimelineEvent& event : view::timeline_events(source)) {
    // An event outside the range of the page's frames cannot be placed; theta_c may lie just after the last.
    const double spacing = source.tilts.size() > 1 ? source.tilts[1] - source.tilts[0] : 0.0;
    if (tilts.empty() || event.tilt < tilts.front() - spacing || event.tilt > tilts.back() + spacing)
      continue;
    texts.push_back(json::line({{"name", json::quoted(event.name)},
                                {"label", json::quoted(event.label)},
                                {"what", json::quoted(event.what)},
                                {"kind", json::quoted(kind_text(event.kind))},
                                {"size", fmt::format("{:.3f}", event.size)},
                                {"tilt", fmt::format("{:.4f}", degrees(event.tilt))},
                                {"place", fmt::format("{:.4f}", view::place_among(tilts, event.tilt))}}));
  }
  return json::list(texts);
}

}  // namespace talus::exports
