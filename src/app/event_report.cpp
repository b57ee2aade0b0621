#include "app/event_report.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <numeric>

#include "analysis/events/power_law.h"
#include "analysis/quantities.h"
#include "app/json.h"
#include "base/text.h"
#include "base/text_table.h"
#include "core/trigonometry.h"
#include "ensemble/plus_minus.h"
#include "runs/event_catalogue.h"

namespace talus::app {
namespace {

constexpr std::string_view group_of_events = "events/";

/// Columns of the table and their units.
constexpr std::pair<const char*, const char*> event_titles[] = {{"theta", "deg"},
                                                                {"waiting", "deg"},
                                                                {"duration", "sqrt(D/g)"},
                                                                {"energy", "m g D"},
                                                                {"peak v", "sqrt(gD)"},
                                                                {"grains", ""},
                                                                {"depth", "D"},
                                                                {"x", "D"},
                                                                {"y", "D"},
                                                                {"dV/V*1e6", ""},
                                                                {"dy/y*1e6", ""},
                                                                {"dz", ""}};

/// Units of the reported events.
struct EventUnits {
  double diameter, energy, velocity, time;

  explicit EventUnits(const RunStatics& statics)
      : diameter(statics.mean_diameter),
        energy(runs::mean_grain_mass(statics) * statics.gravity * diameter),
        velocity(std::sqrt(statics.gravity * diameter)),
        time(std::sqrt(diameter / statics.gravity)) {}
};

std::string_view mark_of(const analysis::EventRecord& event) {
  switch (static_cast<analysis::EventKind>(event.kind)) {
    case analysis::EventKind::failure:
      return "failure";
    case analysis::EventKind::unfinished:
      return "not over";
    case analysis::EventKind::rearrangement:
      break;
  }
  return event.sharing > 1 ? "*" : "";
}

std::vector<TextCell> event_row(const analysis::EventRecord& event, const EventUnits& unit) {
  return {{number_cell("{:.3f}", degrees(event.begin))},
          {number_cell("{:.3f}", degrees(event.waiting))},
          {number_cell("{:.2f}", event.duration / unit.time)},
          {number_cell("{:.3g}", event.energy / unit.energy)},
          {number_cell("{:.4f}", event.peak_velocity / unit.velocity)},
          {std::to_string(event.grains)},
          {number_cell("{:.1f}", event.depth / unit.diameter)},
          {number_cell("{:.1f}", event.centre[0] / unit.diameter)},
          {number_cell("{:.1f}", event.centre[1] / unit.diameter)},
          {number_cell("{:+.2f}", 1e6 * event.volume_strain)},
          {number_cell("{:+.2f}", 1e6 * event.centre_of_mass_strain)},
          {number_cell("{:+.4f}", event.coordination_number)},
          {std::string(mark_of(event))}};
}

/// Returns the indices of the events that are shown, in order.
std::vector<std::size_t> shown_events(const std::vector<analysis::EventRecord>& events, std::size_t largest) {
  std::vector<std::size_t> places(events.size());
  std::iota(places.begin(), places.end(), std::size_t{0});
  if (largest == 0 || largest >= places.size()) return places;
  std::ranges::stable_sort(places, [&](std::size_t a, std::size_t b) {
    const double left = events[a].energy, right = events[b].energy;
    return left > right || (std::isnan(right) && !std::isnan(left));
  });
  places.resize(largest);
  std::ranges::sort(places);
  return places;
}

std::string events_heading(const runs::RunView& run) {
  const analysis::Analysis& analysis = run.analysis;
  const auto tilt = [](double angle) { return degrees_text(angle, 2) + " deg"; };
  const std::size_t count = analysis.events.size();
  return fmt::format(
      "{}  ({})\n{} event{} up to {}; {}\n", run.path, run.kept, count, count == 1 ? "" : "s",
      tilt(analysis.frames.back().tilt),
      std::isnan(analysis.theta_c) ? "the slope has not failed" : "theta_c = " + tilt(analysis.theta_c));
}

std::string threshold_text(const runs::RunView& run, const EventUnits& unit) {
  const analysis::Analysis& analysis = run.analysis;
  if (std::isnan(analysis.event_threshold))
    return "The file has no steps of the tilt, so its events are unknown.\n";
  const double noise = analysis.event_noise;
  const std::string over_noise = noise > 0.0 ? fmt::format(", {:.3g} times that of the median quiet step",
                                                           analysis.event_threshold / noise)
                                             : "";
  return fmt::format(
      "An event: rms velocity of at least {:.2e} sqrt(g D){}, until the bed has been quiet for {:.3g} "
      "sqrt(D/g)\n",
      analysis.event_threshold / unit.velocity, over_noise, analysis.event_quiet_time / unit.time);
}

std::string event_table(const runs::RunView& run, const EventUnits& unit, std::size_t largest) {
  const std::vector<analysis::EventRecord>& events = run.analysis.events;
  const std::vector<std::size_t> shown = shown_events(events, largest);
  TextTable table;
  for (const auto& [title, shown_unit] : event_titles) table.columns.push_back({title, true, shown_unit});
  table.columns.push_back({""});
  for (const std::size_t k : shown) table.rows.push_back(event_row(events[k], unit));
  std::string text = "\n" + aligned_text(table, 1);
  if (shown.size() < events.size())
    text += fmt::format("the {} events of largest energy, of {}\n", shown.size(), events.size());
  if (std::ranges::any_of(events, [](const analysis::EventRecord& event) { return event.sharing > 1; }))
    text += "* shares its frames with other events: grains, depth, x and y refer to all of them together\n";
  return text;
}

std::string too_few(double count) {
  return fmt::format("no law: {:.0f} events, {} needed", count, analysis::min_fitted_values);
}

std::string sizes_line(const analysis::Analysis& analysis, const EventUnits& unit) {
  if (std::isnan(analysis.event_size_exponent)) return too_few(analysis.event_size_count);
  return fmt::format("density ~ E^-a, a = {} for E >= {:.3g} m g D ({:.0f} of {:.0f})",
                     ensemble::plus_minus(analysis.event_size_exponent, analysis.event_size_exponent_error),
                     analysis.event_size_minimum / unit.energy, analysis.event_size_count,
                     analysis.event_count);
}

std::string waits_line(const analysis::Analysis& analysis) {
  if (std::isnan(analysis.event_waiting_exponent)) return too_few(analysis.event_waiting_count);
  return fmt::format(
      "mean {} deg beyond the shortest; as a power law a = {} for angles >= {:.3g} deg ({:.0f})",
      ensemble::plus_minus(degrees(analysis.event_waiting_mean), degrees(analysis.event_waiting_mean_error)),
      ensemble::plus_minus(analysis.event_waiting_exponent, analysis.event_waiting_exponent_error),
      degrees(analysis.event_waiting_minimum), analysis.event_waiting_count);
}

std::string dilating_line(const analysis::Analysis& analysis) {
  const double share = analysis.event_dilating_share, error = analysis.event_dilating_share_error;
  if (std::isnan(share)) return "none";
  return error > 0.0 ? ensemble::plus_minus(share, error) : fmt::format("{:.2f}", share);
}

std::string name_of(const analysis::Quantity& quantity) {
  return quantity.name.substr(group_of_events.size());
}

/// Returns the value of one event, or the pair of values.
Json value_json(const analysis::Quantity& quantity, std::size_t k, const analysis::Analysis& analysis) {
  return std::visit(
      [&](const auto& values) -> Json {
        const std::size_t width = values.size() / analysis.events.size();
        if (width == 1) return values[k];
        return {values[width * k], values[width * k + 1]};
      },
      analysis::values_of(quantity, analysis));
}

std::vector<analysis::Quantity> quantities_of_each() {
  std::vector<analysis::Quantity> chosen = analysis::quantities();
  std::erase_if(chosen, [](const analysis::Quantity& quantity) { return !analysis::is_of_events(quantity); });
  return chosen;
}

std::size_t width_of(const analysis::Quantity& quantity) { return quantity.shape == "E" ? 1 : 2; }

}  // namespace

std::string event_summary(const runs::RunView& run) {
  const analysis::Analysis& analysis = run.analysis;
  if (std::isnan(analysis.event_count)) return "rearrangements: unknown, the file has no steps of the tilt\n";
  const EventUnits unit(run.statics);
  const auto line = [](std::string_view name, const std::string& text) {
    return fmt::format("  {:<34}{}\n", name, text);
  };
  return fmt::format(
      "rearrangements before failure\n{}{}{}{}",
      line("number, and energy released",
           fmt::format("{:.0f}, {:.4g} m g D", analysis.event_count, analysis.event_energy / unit.energy)),
      line("sizes", sizes_line(analysis, unit)), line("waiting angles", waits_line(analysis)),
      line("share that dilates the bed", dilating_line(analysis)));
}

std::string events_text(const runs::RunView& run, std::size_t largest) {
  const EventUnits unit(run.statics);
  return fmt::format("{}{}{}\n{}", events_heading(run), threshold_text(run, unit),
                     run.analysis.events.empty() ? "" : event_table(run, unit, largest), event_summary(run));
}

std::string events_json(const runs::RunView& run) {
  const analysis::Analysis& analysis = run.analysis;
  Json json = {{"path", run.path},
               {"state", run.kept},
               {"mean_diameter", run.statics.mean_diameter},
               {"mean_mass", runs::mean_grain_mass(run.statics)},
               {"gravity", run.statics.gravity},
               {"theta_c", analysis.theta_c}};
  for (const analysis::Quantity& quantity : analysis::quantities())
    if (quantity.name.starts_with(group_of_events) && !analysis::is_of_events(quantity))
      json[name_of(quantity)] = analysis::number_of(quantity, analysis, 0);
  json["events"] = Json::array();
  for (std::size_t k = 0; k < analysis.events.size(); ++k) {
    Json& event = json["events"].emplace_back(Json::object());
    for (const analysis::Quantity& quantity : quantities_of_each())
      event[name_of(quantity)] = value_json(quantity, k, analysis);
  }
  return json_text(json);
}

std::string events_csv(const runs::RunView& run, bool titles) {
  TextTable table{{{"run"}}, {}};
  for (const analysis::Quantity& quantity : quantities_of_each()) {
    const std::string unit = quantity.unit == "1" ? "" : fmt::format(" ({})", quantity.unit);
    for (std::size_t i = 0; i < width_of(quantity); ++i) {
      const std::string element = width_of(quantity) == 1 ? "" : fmt::format("[{}]", i);
      table.columns.push_back({name_of(quantity) + element + unit});
    }
  }
  for (std::size_t k = 0; k < run.analysis.events.size(); ++k) {
    auto& row = table.rows.emplace_back();
    row.push_back({csv_quoted(run.path)});
    for (const analysis::Quantity& quantity : quantities_of_each())
      std::visit(
          [&](const auto& values) {
            const std::size_t width = width_of(quantity);
            for (std::size_t i = width * k; i < width * (k + 1); ++i)
              row.push_back({std::isnan(static_cast<double>(values[i])) ? "" : fmt::format("{}", values[i])});
          },
          analysis::values_of(quantity, run.analysis));
  }
  return csv_text(table, titles);
}

std::string moves_text(const MovedGrains& grains) {
  constexpr std::size_t max_rows = 20;
  const std::size_t count = grains.moves.size(), shown = std::min(count, max_rows);
  const EventUnits unit(grains.statics);
  std::string text = fmt::format("{}\n{} of {} grains moved {:.6g} D or more since the tilt began\n",
                                 grains.path, count, grains.statics.free_count, grains.displacement);
  if (count == 0) return text;
  TextTable table{{{"grain", true},
                   {"frame", true},
                   {"theta", true, "deg"},
                   {"time", true, "s"},
                   {"x", true, "D"},
                   {"y", true, "D"},
                   {"depth", true, "D"},
                   {"moved", true, "D"}},
                  {}};
  for (const runs::FirstMove& move : std::span(grains.moves).first(shown))
    table.rows.push_back({{std::to_string(move.grain)},
                          {std::to_string(move.frame)},
                          {number_cell("{:.3f}", degrees(move.tilt))},
                          {number_cell("{:.3f}", move.time)},
                          {number_cell("{:.1f}", move.x / unit.diameter)},
                          {number_cell("{:.1f}", move.y / unit.diameter)},
                          {number_cell("{:.1f}", move.depth / unit.diameter)},
                          {number_cell("{:.4g}", move.displacement / unit.diameter)}});
  text += "\n" + aligned_text(table, 1);
  if (shown < count) text += fmt::format("the first {}; --csv and --json list all\n", shown);
  return text;
}

namespace {

/// A reported value of a move and its unit.
struct MoveField {
  const char *name, *unit;
  Json (*value)(const runs::FirstMove& move);
};
constexpr MoveField move_fields[] = {
    {"grain", "", [](const runs::FirstMove& move) -> Json { return move.grain; }},
    {"frame", "", [](const runs::FirstMove& move) -> Json { return move.frame; }},
    {"tilt", "rad", [](const runs::FirstMove& move) -> Json { return move.tilt; }},
    {"time", "s", [](const runs::FirstMove& move) -> Json { return move.time; }},
    {"x", "m", [](const runs::FirstMove& move) -> Json { return move.x; }},
    {"y", "m", [](const runs::FirstMove& move) -> Json { return move.y; }},
    {"depth", "m", [](const runs::FirstMove& move) -> Json { return move.depth; }},
    {"displacement", "m", [](const runs::FirstMove& move) -> Json { return move.displacement; }},
};

}  // namespace

std::string moves_json(const MovedGrains& grains) {
  const double diameter = grains.statics.mean_diameter;
  Json json = {{"path", grains.path},
               {"mean_diameter", diameter},
               {"displacement", grains.displacement * diameter},
               {"grains", Json::array()}};
  for (const runs::FirstMove& move : grains.moves) {
    Json& row = json["grains"].emplace_back(Json::object());
    for (const MoveField& field : move_fields) row[field.name] = field.value(move);
  }
  return json_text(json);
}

std::string moves_csv(const MovedGrains& grains, bool titles) {
  TextTable table{{{"run"}}, {}};
  for (const MoveField& field : move_fields)
    table.columns.push_back({field.name + (*field.unit ? fmt::format(" ({})", field.unit) : std::string())});
  for (const runs::FirstMove& move : grains.moves) {
    auto& row = table.rows.emplace_back();
    row.push_back({csv_quoted(grains.path)});
    for (const MoveField& field : move_fields) row.push_back({field.value(move).dump()});
  }
  return csv_text(table, titles);
}

}  // namespace talus::app
