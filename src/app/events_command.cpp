/// `talus events`: lists the rearrangements of runs in a table.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fmt/core.h>
#include <memory>
#include <numeric>
#include <optional>

#include "analysis/events/events.h"
#include "analysis/quantities.h"
#include "app/analysis_report.h"
#include "app/commands.h"
#include "app/json.h"
#include "app/options.h"
#include "app/progress.h"
#include "app/run_files.h"
#include "app/terminal.h"
#include "base/text.h"
#include "core/trigonometry.h"
#include "ensemble/member_results.h"
#include "runs/analysis_parameters.h"
#include "runs/event_catalogue.h"

namespace talus::app {
namespace {

constexpr std::string_view group_of_events = "events/";

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

using Event = analysis::EventRecord;

/// A column of the table: its value in SI units, radians or a number, and the unit in which it is shown.
struct EventColumn {
  const char *title, *unit, *format;
  double (*value)(const Event& event);
  double EventUnits::*scale = nullptr;
};
constexpr EventColumn event_columns[] = {
    {"theta", "deg", "{:.3f}", [](const Event& event) { return degrees(event.begin); }},
    {"waiting", "deg", "{:.3f}", [](const Event& event) { return degrees(event.waiting); }},
    {"duration", "sqrt(D/g)", "{:.2f}", [](const Event& event) { return event.duration; }, &EventUnits::time},
    {"energy", "m g D", "{:.3g}", [](const Event& event) { return event.energy; }, &EventUnits::energy},
    {"peak v", "sqrt(gD)", "{:.4f}", [](const Event& event) { return event.peak_velocity; },
     &EventUnits::velocity},
    {"grains", "", "{:.0f}", [](const Event& event) { return static_cast<double>(event.grains); }},
    {"depth", "D", "{:.1f}", [](const Event& event) { return event.depth; }, &EventUnits::diameter},
    {"x", "D", "{:.1f}", [](const Event& event) { return event.centre[0]; }, &EventUnits::diameter},
    {"y", "D", "{:.1f}", [](const Event& event) { return event.centre[1]; }, &EventUnits::diameter},
    {"dV/V*1e6", "", "{:+.2f}", [](const Event& event) { return 1e6 * event.volume_strain; }},
    {"dy/y*1e6", "", "{:+.2f}", [](const Event& event) { return 1e6 * event.centre_of_mass_strain; }},
    {"dz", "", "{:+.4f}", [](const Event& event) { return event.coordination_number; }}};

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
  return fmt::format(
      "{}  ({})\n{} up to {}; {}\n", run.path, run.kept, counted(analysis.events.size(), "event"),
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
  for (const EventColumn& column : event_columns) table.columns.push_back({column.title, true, column.unit});
  table.columns.push_back({""});
  for (const std::size_t k : shown) {
    auto& row = table.rows.emplace_back();
    for (const EventColumn& column : event_columns)
      row.push_back(
          {number_cell(column.format, column.value(events[k]) / (column.scale ? unit.*column.scale : 1.0))});
    row.push_back({std::string(mark_of(events[k]))});
  }
  std::string text = "\n" + aligned_text(table, 1);
  if (shown.size() < events.size())
    text += fmt::format("the {} of largest energy, of {}\n", counted(shown.size(), "event"), events.size());
  if (std::ranges::any_of(shown, [&events](std::size_t k) { return events[k].grains == 0; }))
    text += "0 grains: none moved by event_displacement between the frames around the event\n";
  if (std::ranges::any_of(events, [](const analysis::EventRecord& event) { return event.sharing > 1; }))
    text += "* shares its frames with other events: grains, depth, x and y refer to all of them together\n";
  return text;
}

std::string too_few(double count) {
  return fmt::format("no law: {}, {} needed", counted(static_cast<std::size_t>(count), "event"),
                     analysis::min_fitted_values);
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

/// A table for programs, in SI units and radians: as JSON a list of rows, as CSV lines.
struct ExactTable {
  struct Column {
    std::string name, unit;  ///< no unit: empty
    std::size_t width = 1;   ///< numbers in each value
  };
  Json head;         ///< members before the list, of which "path" names the run
  std::string list;  ///< "events"
  std::vector<Column> columns;
  std::vector<std::vector<Json>> rows = {};
};

std::string json_of(const ExactTable& table) {
  Json json = table.head;
  Json& list = json[table.list] = Json::array();
  for (const std::vector<Json>& row : table.rows) {
    Json& object = list.emplace_back(Json::object());
    for (std::size_t k = 0; k < row.size(); ++k) object[table.columns[k].name] = row[k];
  }
  return json_text(json);
}

/// Returns CSV, empty for missing values. The title line, with units, is the same for all runs.
std::string csv_of(const ExactTable& exact, bool titles) {
  const auto cell = [](const Json& value) {
    if (value.is_number_integer()) return value.dump();
    return std::isnan(value.get<double>()) ? "" : fmt::format("{}", value.get<double>());
  };
  TextTable table{{{"run"}}, {}};
  for (const auto& [name, unit, width] : exact.columns)
    for (std::size_t i = 0; i < width; ++i)
      table.columns.push_back({name + (width == 1 ? "" : fmt::format("[{}]", i)) +
                               (unit.empty() ? "" : fmt::format(" ({})", unit))});
  for (const std::vector<Json>& values : exact.rows) {
    auto& row = table.rows.emplace_back();
    row.push_back({csv_quoted(exact.head["path"].get<std::string>())});
    for (const Json& value : values)
      for (const Json& number : value.is_array() ? value : Json::array({value}))
        row.push_back({cell(number)});
  }
  return csv_text(table, titles);
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

/// Returns the scalars of the run and its events, under the names of the table of quantities.
ExactTable exact_events(const runs::RunView& run) {
  const analysis::Analysis& analysis = run.analysis;
  ExactTable table{{{"path", run.path},
                    {"state", run.kept},
                    {"mean_diameter", run.statics.mean_diameter},
                    {"mean_mass", runs::mean_grain_mass(run.statics)},
                    {"gravity", run.statics.gravity},
                    {"theta_c", analysis.theta_c}},
                   "events",
                   {}};
  table.rows.resize(analysis.events.size());
  for (const analysis::Quantity& quantity : analysis::quantities()) {
    if (analysis::is_of_events(quantity)) {
      table.columns.push_back(
          {name_of(quantity), quantity.unit == "1" ? "" : quantity.unit, quantity.shape == "E" ? 1u : 2u});
      for (std::size_t k = 0; k < table.rows.size(); ++k)
        table.rows[k].push_back(value_json(quantity, k, analysis));
    } else if (quantity.name.starts_with(group_of_events)) {
      table.head[name_of(quantity)] = analysis::number_of(quantity, analysis, 0);
    }
  }
  return table;
}

std::string events_text(const runs::RunView& run, std::size_t largest) {
  const EventUnits unit(run.statics);
  return fmt::format("{}{}{}\n{}", events_heading(run), threshold_text(run, unit),
                     run.analysis.events.empty() ? "" : event_table(run, unit, largest), event_summary(run));
}

/// Grains of a run that moved by at least `displacement`, in order (runs/event_catalogue.h).
struct MovedGrains {
  std::string path;
  RunStatics statics;
  double displacement = 0.0;  ///< D
  std::vector<runs::FirstMove> moves;
};

using Move = runs::FirstMove;

/// A value of a move as JSON and CSV have it, and as the table shows it.
struct MoveField {
  const char *name, *unit;
  const char *title, *shown_unit, *format;
  double (*value)(const Move& move);
};
constexpr MoveField move_fields[] = {
    {"grain", "", "grain", "", "{:.0f}", [](const Move& move) { return static_cast<double>(move.grain); }},
    {"frame", "", "frame", "", "{:.0f}", [](const Move& move) { return static_cast<double>(move.frame); }},
    {"tilt", "rad", "theta", "deg", "{:.3f}", [](const Move& move) { return move.tilt; }},
    {"time", "s", "time", "s", "{:.3f}", [](const Move& move) { return move.time; }},
    {"x", "m", "x", "D", "{:.1f}", [](const Move& move) { return move.x; }},
    {"y", "m", "y", "D", "{:.1f}", [](const Move& move) { return move.y; }},
    {"depth", "m", "depth", "D", "{:.1f}", [](const Move& move) { return move.depth; }},
    {"displacement", "m", "moved", "D", "{:.4g}", [](const Move& move) { return move.displacement; }},
};

/// Returns the value in the unit of the file, SI; numbers of grains and frames are integers.
Json value_json(const MoveField& field, const runs::FirstMove& move) {
  const double value = field.value(move);
  return *field.unit ? Json(value) : Json(static_cast<std::int64_t>(value));
}

ExactTable exact_moves(const MovedGrains& grains) {
  const double diameter = grains.statics.mean_diameter;
  ExactTable table{
      {{"path", grains.path}, {"mean_diameter", diameter}, {"displacement", grains.displacement * diameter}},
      "grains",
      {}};
  for (const MoveField& field : move_fields) table.columns.push_back({field.name, field.unit});
  for (const Move& move : grains.moves) {
    auto& row = table.rows.emplace_back();
    for (const MoveField& field : move_fields) row.push_back(value_json(field, move));
  }
  return table;
}

/// Returns the first of the moves in a table.
std::string moves_text(const MovedGrains& grains) {
  constexpr std::size_t max_rows = 20;
  const std::size_t count = grains.moves.size(), shown = std::min(count, max_rows);
  std::string text = fmt::format("{}\n{} of {} grains moved {:.6g} D or more since the tilt began\n",
                                 grains.path, count, grains.statics.free_count, grains.displacement);
  if (count == 0) return text;
  TextTable table;
  for (const MoveField& field : move_fields) table.columns.push_back({field.title, true, field.shown_unit});
  for (const runs::FirstMove& move : std::span(grains.moves).first(shown)) {
    auto& row = table.rows.emplace_back();
    for (const MoveField& field : move_fields) {
      const double value = field.value(move);
      const std::string_view unit = field.shown_unit;
      row.push_back({number_cell(field.format, unit == "deg" ? degrees(value)
                                               : unit == "D" ? value / grains.statics.mean_diameter
                                                             : value)});
    }
  }
  text += "\n" + aligned_text(table, 1);
  if (shown < count) text += fmt::format("the first {}; --csv and --json list all\n", shown);
  return text;
}

}  // namespace

std::string event_summary(const runs::RunView& run) {
  const analysis::Analysis& analysis = run.analysis;
  if (std::isnan(analysis.event_count)) return "rearrangements: unknown, the file has no steps of the tilt\n";
  const EventUnits unit(run.statics);
  const auto line = [](std::string_view name, const std::string& text) {
    return fmt::format("  {:<34}{}\n", name, text);
  };
  return fmt::format(
      "rearrangements{}\n{}{}{}{}", std::isfinite(analysis.theta_c) ? " before failure" : "",
      line("number, and energy released",
           fmt::format("{:.0f}, {:.4g} m g D", analysis.event_count, analysis.event_energy / unit.energy)),
      line("sizes", sizes_line(analysis, unit)), line("waiting angles", waits_line(analysis)),
      line("share that dilates the bed", dilating_line(analysis)));
}

namespace {

struct EventsArguments {
  std::vector<std::string> runs;
  std::vector<std::string> settings;
  runs::AnalysisOptions options;
  std::size_t largest = 0;
  std::optional<double> displacement;  ///< D
  bool json = false, csv = false, quiet = false;
};

MovedGrains moved_grains(const std::string& path, double displacement) {
  const io::RunFile run = io::RunFile::open(path);
  const RunStatics& statics = run.header().statics;
  return {path, statics, displacement, runs::first_moves(run, displacement * statics.mean_diameter)};
}

void list_events(const EventsArguments& arguments) {
  const analysis::AnalysisParameters parameters = runs::parse_analysis_settings(arguments.settings);
  runs::AnalysisOptions options = arguments.options;
  options.progress = count_shown("analysis", arguments.quiet);
  bool first = true;
  for (const std::string& path : with_members(runs_among(arguments.runs))) {
    std::optional<MovedGrains> grains;
    std::optional<runs::RunView> run;
    if (arguments.displacement)
      grains = moved_grains(path, *arguments.displacement);
    else
      run = runs::analysed_run(path, parameters, options);
    const auto exact = [&] { return grains ? exact_moves(*grains) : exact_events(*run); };
    if (arguments.json)
      print_text((first ? "[" : ",\n") + json_of(exact()));
    else if (arguments.csv)
      print_text(csv_of(exact(), first));
    else
      print_text((first ? "" : "\n") + (grains ? moves_text(*grains) : events_text(*run, arguments.largest)));
    std::fflush(stdout);
    first = false;
  }
  if (arguments.json) print("]\n");
}

}  // namespace

void add_events_command(CLI::App& app) {
  auto arguments = std::make_shared<EventsArguments>();
  CLI::App* command = app.add_subcommand("events",
                                         "List the rearrangements of runs before failure with angle, size "
                                         "and place; or the first grains that move");
  command
      ->add_option("RUNS", arguments->runs,
                   "Run files, or folders of ensembles. A missing analysis is computed and stored, as by "
                   "talus analyze")
      ->required();
  auto* largest = add_option(*command, "--largest", arguments->largest, "N",
                             "Number of events of each run, those of largest energy [all]")
                      ->check(in_range<std::size_t>(1, 1000000));
  auto* settings = add_analysis_settings(*command, arguments->settings, "event_velocity=0.05");
  add_option(
      *command, "--displacement", arguments->displacement, "D",
      "List, instead of events, the first grains displaced this far, in mean diameters, since the tilt began")
      ->check(in_range(1e-6, 1e6))
      ->excludes(largest)
      ->excludes(settings);
  auto* json = command->add_flag(
      "--json", arguments->json,
      "Print a JSON list with all scalars of each run and its events, in SI units and radians");
  command->add_flag("--csv", arguments->csv, "Print CSV, one table of all runs, in SI units and radians")
      ->excludes(json)
      ->excludes(largest);
  json->excludes(largest);
  command->add_flag("-q,--quiet", arguments->quiet, "Show no progress");
  command->footer(
      "Energy: work of gravity on the grains. Grains, depth, x, y: number, depth and\ncentre of the grains "
      "that moved between the frames around the event.\ndV/V, dy/y: change of the volume and of the height "
      "of the centre of mass,\npositive if the bed dilates; dz: change of the coordination "
      "number.\ndocs/analysis.md defines all of them. --displacement: in the frame of the bed,\nfrom the "
      "frames of the run; x, y and depth below the mean surface refer to the\nfirst frame in which the grain "
      "has moved.");
  command->callback([arguments] { list_events(*arguments); });
}

}  // namespace talus::app
