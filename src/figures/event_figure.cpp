#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <functional>

#include "analysis/events/power_law.h"
#include "core/trigonometry.h"
#include "ensemble/plus_minus.h"
#include "figures/group_table.h"
#include "figures/recipes.h"
#include "runs/event_catalogue.h"

namespace talus::figures {
namespace {

/// A rearrangement in the units of the figure.
struct FigureEvent {
  const runs::RunView* run;
  const analysis::EventRecord* event;
  double energy;  ///< m g D
};

/// Returns the rearrangements of all runs, run by run.
std::vector<FigureEvent> rearrangements_of(const RunChoice& runs) {
  std::vector<FigureEvent> events;
  for (const runs::RunView* run : runs) {
    const RunStatics& statics = run->file->header().statics;
    const double unit = runs::mean_grain_mass(statics) * statics.gravity * statics.mean_diameter;
    for (const analysis::EventRecord& event : run->analysis.events)
      if (event.kind == static_cast<Index>(analysis::EventKind::rearrangement))
        events.push_back({run, &event, event.energy / unit});
  }
  return events;
}

std::vector<Column> event_columns(const std::vector<FigureEvent>& events) {
  std::vector<Column> columns = {
      {"theta", "deg", "magnitude of the tilt at which the rearrangement begins", {}},
      {"seed", "1", "seed of its run", {}},
      {"energy", "m g D", "energy released", {}},
      {"waiting", "deg", "tilt since the end of the preceding event", {}},
      {"duration", "sqrt(D/g)", "duration", {}},
      {"grains", "1", "grains moved", {}},
      {"depth", "D", "depth above which 95 % of their displacement lies", {}},
      {"volume_strain", "1e-6", "change of the volume strain", {}},
      {"centre_of_mass_strain", "1e-6", "change of the strain of the centre of mass", {}},
  };
  for (const FigureEvent& entry : events) {
    const analysis::EventRecord& event = *entry.event;
    const double diameter = entry.run->statics.mean_diameter;
    const double time = std::sqrt(diameter / entry.run->file->header().statics.gravity);
    const double row[] = {degrees(std::abs(event.begin)),
                          static_cast<double>(entry.run->scenario.seed),
                          entry.energy,
                          degrees(event.waiting),
                          event.duration / time,
                          static_cast<double>(event.grains),
                          event.depth / diameter,
                          1e6 * event.volume_strain,
                          1e6 * event.centre_of_mass_strain};
    for (std::size_t k = 0; k < std::size(row); ++k) columns[k].values.push_back(row[k]);
  }
  return columns;
}

/// A law for the share of values that are at least x, valid from `minimum` upwards.
struct SampleLaw {
  std::string name, meaning;
  double minimum = not_known;
  std::function<double(double x)> share_from;
};

/// Returns the share of values that are at least as large as each value, and the same by laws scaled to the
/// share of the values at their minimum; NaN below it. Without values there is one row of NaN, because
/// gnuplot warns about empty data.
Table share_table(std::string name, Column values, const std::vector<SampleLaw>& laws) {
  std::erase_if(values.values, [](double value) { return !(value > 0.0); });
  std::ranges::sort(values.values);
  const auto count = static_cast<double>(values.values.size());
  Column share{"share", "1", "share of values that are at least as large", {}};
  for (std::size_t k = 0; k < values.values.size(); ++k)
    share.values.push_back(1.0 - static_cast<double>(k) / count);
  if (values.values.empty()) values.values = share.values = {not_known};
  Table table{std::move(name), {std::move(values), std::move(share)}};
  for (const SampleLaw& law : laws) {
    const std::vector<double>& ascending = table.columns[0].values;
    const auto below = std::ranges::lower_bound(ascending, law.minimum) - ascending.begin();
    const double from_minimum = 1.0 - static_cast<double>(below) / count;
    Column by_law{law.name, "1", law.meaning, {}};
    for (const double x : ascending)
      by_law.values.push_back(x >= law.minimum ? from_minimum * law.share_from(x) : not_known);
    table.columns.push_back(std::move(by_law));
  }
  return table;
}

SampleLaw sample_law(const analysis::PowerLaw& law) {
  return {"power_law", "the same from the maximum-likelihood power law; NaN below its minimum",
          std::isnan(law.exponent) ? not_known : law.minimum, [law](double x) { return law.share_from(x); }};
}

SampleLaw sample_law(const analysis::ExponentialLaw& law, double shortest) {
  return {"exponential_law", "the same from the maximum-likelihood exponential law",
          std::isnan(law.mean) ? not_known : shortest,
          [law, shortest](double x) { return std::exp((shortest - x) / law.mean); }};
}

void add_table(Figure& figure, const std::string& variable, Table table) {
  figure.tables.push_back(std::move(table));
  set_variable(figure, variable, gnuplot_string(file_of(figure, figure.tables.back())));
}

/// Returns the law of sizes: "α = 1.57 ± 0.13 (19 of 43)".
std::string size_text(const analysis::PowerLaw& law, std::size_t all) {
  if (std::isnan(law.exponent)) return fmt::format("too few for a law: {}", all);
  return fmt::format("α = {} ({} of {})", ensemble::plus_minus(law.exponent, law.error), law.count, all);
}

/// Returns the laws of waiting angles: "α = 1.93 ± 0.16, mean 0.24 ± 0.04°".
std::string wait_text(const analysis::PowerLaw& law, const analysis::ExponentialLaw& exponential) {
  if (std::isnan(law.exponent) || std::isnan(exponential.mean))
    return fmt::format("too few for a law: {}", exponential.count);
  return fmt::format("α = {}, mean {}°", ensemble::plus_minus(law.exponent, law.error),
                     ensemble::plus_minus(exponential.mean, exponential.error));
}

void add_laws(Figure& figure, const RunGroup& group, const std::vector<Column>& columns) {
  const std::string g = std::to_string(figure.groups), name = table_name(group);
  const Column &energy = columns[2], &waiting = columns[3];
  const analysis::PowerLaw size = analysis::power_law(energy.values),
                           wait = analysis::power_law(waiting.values);
  double shortest = not_known;
  for (const double angle : waiting.values) shortest = std::fmin(shortest, angle);
  const analysis::ExponentialLaw exponential = analysis::exponential_law(waiting.values, shortest);
  add_table(figure, "sizes_" + g, share_table("sizes-" + name, energy, {sample_law(size)}));
  add_table(figure, "waits_" + g,
            share_table("waits-" + name, waiting, {sample_law(wait), sample_law(exponential, shortest)}));
  set_variable(figure, "size_law_" + g, gnuplot_string(size_text(size, energy.values.size())));
  set_variable(figure, "wait_law_" + g, gnuplot_string(wait_text(wait, exponential)));
}

/// Returns the number of rows of the largest table.
std::size_t max_events(const Figure& figure) {
  std::size_t most = 1;
  for (const Table& table : figure.tables) most = std::max(most, table.columns[0].values.size());
  return most;
}

/// Sets the ends of a logarithmic axis with room for all positive values of a column. A single value gets a
/// wider range because gnuplot warns about an empty one.
void set_range(Figure& figure, const std::string& column_name, const std::string& variable) {
  double least = not_known, largest = not_known;
  for (const Table& table : figure.tables)
    for (const Column& column : table.columns)
      if (column.name == column_name)
        for (const double value : column.values)
          if (value > 0.0) {
            least = std::fmin(least, value);
            largest = std::fmax(largest, value);
          }
  if (std::isnan(least)) least = largest = 1.0;
  const double room = largest > least ? std::pow(largest / least, 0.05) : 4.0;
  set_variable(figure, variable + "_from", least / room);
  set_variable(figure, variable + "_to", largest * room);
}

/// Returns the end of the symmetric axis of the changes of height, beyond all values.
double largest_change(const Figure& figure) {
  double largest = 1.0;
  for (const Table& table : figure.tables)
    for (const Column& column : table.columns)
      if (column.name == "centre_of_mass_strain")
        for (const double change : column.values) largest = std::fmax(largest, std::fabs(change));
  return 2.0 * largest;
}

}  // namespace

std::optional<Figure> event_figure(std::span<const RunGroup> groups) {
  Figure figure;
  figure.name = "events";
  figure.title = "Rearrangements on the way to failure";
  figure.caption =
      "Rearrangements of the bed before failure, bursts of motion between two quiet periods, for all runs of "
      "a group together: (a) share that released at least a given energy, in m g D; lines: "
      "maximum-likelihood power law, density ~ E^-α, from the energy with the smallest Kolmogorov-Smirnov "
      "distance. (b) share with at least a given waiting angle, the tilt since the end of the preceding "
      "event; solid lines: power law, dotted: exponential law beyond the shortest. (c) energy over the tilt "
      "at which each begins. (d) change of the height of the centre of mass over its height at the start, in "
      "1e-6: above 0 the bed dilates, below it compacts; the axis is linear near 0 and logarithmic beyond.";
  figure.wide = true;
  figure.height_over_width = 0.62;
  for (const RunGroup& group : groups) {
    const RunChoice runs = with_files(all_runs(group));
    std::vector<Column> columns = event_columns(rearrangements_of(runs));
    if (columns[0].values.empty()) continue;
    add_group_table(figure, group, runs, columns);
    add_laws(figure, group, columns);
  }
  if (figure.groups == 0) return std::nullopt;
  set_range(figure, "energy", "energy");
  set_range(figure, "waiting", "waiting");
  set_variable(figure, "events_most", static_cast<double>(max_events(figure)));
  set_variable(figure, "largest_change", largest_change(figure));
  return figure;
}

}  // namespace talus::figures
