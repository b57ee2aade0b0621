#include "figures/angle_figures.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <iterator>

#include "core/statistics.h"
#include "core/trigonometry.h"
#include "ensemble/member_numbers.h"
#include "ensemble/plus_minus.h"
#include "figures/theta_d_estimators.h"

namespace talus {
namespace {

constexpr int least_runs = 2;
constexpr std::size_t most_bins = 60;
constexpr std::size_t panels_in_row = 3;

std::size_t count_numbers(const std::vector<double>& values) {
  return static_cast<std::size_t>(statistics_of(values).count);
}

/// The largest of 1, 2, 2.5 and 5 times a power of ten that is not above `most`, which is positive.
double round_step(double most) {
  const double decade = std::pow(10.0, std::floor(std::log10(most)));
  double step = decade;
  for (const double factor : {2.0, 2.5, 5.0})
    if (factor * decade <= most) step = factor * decade;
  return step;
}

/// The groups of a figure that have several runs, and their angles.
struct AngleGroups {
  std::vector<const RunGroup*> groups;
  std::vector<RunChoice> choices;
  std::vector<RunAngle> angles;
};

AngleGroups angle_groups(std::span<const RunGroup> groups) {
  AngleGroups found;
  for (const RunGroup& group : groups) {
    if (group.runs.size() < least_runs) continue;
    found.groups.push_back(&group);
    found.choices.push_back(all_runs(group));
  }
  if (!found.groups.empty()) found.angles = run_angles(found.choices);
  return found;
}

/// Adds a table for each group: the seed, and all angles, of each run.
void add_angle_tables(Figure& figure, const AngleGroups& all) {
  for (std::size_t g = 0; g < all.groups.size(); ++g) {
    std::vector<Column> columns = {{"seed", "1", "seed of the run", {}}};
    for (const FigureRun* run : all.choices[g])
      columns[0].values.push_back(static_cast<double>(run->scenario.seed));
    for (const RunAngle& angle : all.angles)
      columns.push_back({angle.name, "deg", angle.meaning, angle.values[g]});
    add_group_table(figure, *all.groups[g], all.choices[g], std::move(columns));
  }
  set_more_keys(figure, 0);
}

/// "mean 19.16 ± 0.09, median 19.17, n = 50"
std::string summary_text(const std::vector<double>& values) {
  const Summary summary = summary_of(values, {});
  const Statistics& found = summary.statistics;
  if (found.count == 0) return "none";
  const std::string mean = found.count > 1 && found.error > 0.0 ? plus_minus(found.mean, found.error)
                                                                : fmt::format("{:.2f}", found.mean);
  return fmt::format("mean {}, median {:.2f}, n = {}", mean, summary.median, found.count);
}

/// The share of its runs that a group has in each bin.
Table histogram_table(const RunAngle& angle) {
  std::vector<double> together;
  for (const std::vector<double>& of_group : angle.values)
    together.insert(together.end(), of_group.begin(), of_group.end());
  const HistogramBins bins = bins_for(together);
  Table table{
      "bins-" + angle.name,
      {{"from", "deg", "lower edge of a bin of " + angle.meaning, {}}, {"to", "deg", "its upper edge", {}}}};
  std::ranges::replace_if(
      table.name, [](char c) { return c == '/' || c == '['; }, '-');
  std::erase(table.name, ']');
  for (std::size_t b = 0; b < bins.count; ++b) {
    table.columns[0].values.push_back(bins.first + static_cast<double>(b) * bins.width);
    table.columns[1].values.push_back(bins.first + static_cast<double>(b + 1) * bins.width);
  }
  for (std::size_t g = 0; g < angle.values.size(); ++g) {
    Column share{fmt::format("share_{}", g + 1), "1",
                 fmt::format("share of the runs of group {} that have it", g + 1),
                 std::vector<double>(bins.count)};
    for (const double value : angle.values[g])
      if (!std::isnan(value))
        share.values[static_cast<std::size_t>((value - bins.first) / bins.width)] +=
            1.0 / static_cast<double>(count_numbers(angle.values[g]));
    table.columns.push_back(std::move(share));
  }
  return table;
}

/// What the histograms of one angle are called and say.
void add_histogram(Figure& figure, const RunAngle& angle, std::size_t panel) {
  const std::string k = std::to_string(panel);
  figure.tables.push_back(histogram_table(angle));
  set_variable(figure, "bins_" + k, gnuplot_string(file_of(figure, figure.tables.back())));
  set_variable(figure, "title_" + k, gnuplot_string(angle.label));
  for (std::size_t g = 0; g < angle.values.size(); ++g) {
    set_variable(figure, fmt::format("summary_{}_{}", k, g + 1),
                 gnuplot_string(summary_text(angle.values[g])));
    set_variable(figure, fmt::format("mean_{}_{}", k, g + 1), statistics_of(angle.values[g]).mean);
  }
}

/// Whether it is at a threshold beyond the first.
bool is_of_further_threshold(const RunAngle& angle) {
  return angle.name.ends_with(']') && !angle.name.starts_with(quantity_of(&Analysis::dilation).name);
}

/// The coefficients of all pairs, in the order of the panels.
Table coefficient_table(const std::vector<RunAngle>& angles, std::size_t groups) {
  Table table{"coefficients",
              {{"first", "1", "number of the angle on the horizontal axis", {}},
               {"second", "1", "number of the angle on the vertical axis", {}}}};
  for (std::size_t k = 0; k < angles.size(); ++k)
    table.columns[0].meaning += fmt::format("{} {} {}", k == 0 ? ":" : ";", k + 1, angles[k].meaning);
  for (std::size_t g = 1; g <= groups; ++g) {
    table.columns.push_back(
        {fmt::format("r_{}", g), "1", fmt::format("Pearson's coefficient of group {}", g), {}});
    table.columns.push_back({fmt::format("n_{}", g), "1", "runs that have both angles", {}});
  }
  for (std::size_t second = 1; second < angles.size(); ++second)
    for (std::size_t first = 0; first < second; ++first) {
      table.columns[0].values.push_back(static_cast<double>(first + 1));
      table.columns[1].values.push_back(static_cast<double>(second + 1));
      for (std::size_t g = 0; g < groups; ++g) {
        const Correlation found = correlation_of(angles[first].values[g], angles[second].values[g]);
        table.columns[2 * g + 2].values.push_back(found.coefficient);
        table.columns[2 * g + 3].values.push_back(found.count);
      }
    }
  return table;
}

/// The range of an axis for all values of an angle, with room at both ends.
void set_range(Figure& figure, const RunAngle& angle, std::size_t k) {
  std::vector<double> numbers;
  for (const std::vector<double>& of_group : angle.values)
    std::ranges::copy_if(of_group, std::back_inserter(numbers),
                         [](double value) { return !std::isnan(value); });
  const auto [low, high] = std::ranges::minmax(numbers);
  const double room = high > low ? 0.08 * (high - low) : 0.5;
  set_variable(figure, fmt::format("low_{}", k), low - room);
  set_variable(figure, fmt::format("high_{}", k), high + room);
  set_variable(figure, fmt::format("step_{}", k), round_step(0.4 * (high - low + 2.0 * room)));
}

/// "r = 0.42", or nothing, for each row of the coefficients of a group.
void set_coefficient_texts(Figure& figure, const Table& table, std::size_t groups) {
  for (std::size_t row = 0; row < table.columns[0].values.size(); ++row)
    for (std::size_t g = 0; g < groups; ++g) {
      const double r = table.columns[2 * g + 2].values[row];
      set_variable(figure,
                   fmt::format("r_{:.0f}_{:.0f}_{}", table.columns[0].values[row],
                               table.columns[1].values[row], g + 1),
                   gnuplot_string(std::isnan(r) ? std::string() : fmt::format("{{/:Italic r}} = {:.2f}", r)));
    }
}

}  // namespace

std::vector<RunAngle> run_angles(const std::vector<RunChoice>& choices) {
  std::vector<RunAngle> angles;
  const auto add = [&](RunAngle angle, const auto& value_of) {
    bool is_known = false;
    for (const RunChoice& runs : choices) {
      std::vector<double>& values = angle.values.emplace_back();
      for (const FigureRun* run : runs) values.push_back(value_of(*run));
      is_known = is_known || count_numbers(values) >= least_runs;
    }
    if (is_known) angles.push_back(std::move(angle));
  };
  add({quantity_of(&Analysis::theta_c).name, "{/:Italic θ_c}", "theta_c, angle of repose", {}},
      [](const FigureRun& run) { return degrees(run.analysis.theta_c); });
  add({quantity_of(&Analysis::first_slide).name, "first slide", "first slide of the surface layer", {}},
      [](const FigureRun& run) { return degrees(run.analysis.first_slide); });
  add({"theta_r", "{/:Italic θ_r}", "theta_r, angle at rest after failure", {}},
      [](const FigureRun& run) { return degrees(run.theta_r); });
  RunChoice all;
  for (const RunChoice& runs : choices) all.insert(all.end(), runs.begin(), runs.end());
  if (all.empty()) return angles;
  std::vector<Estimator> estimators = estimators_of(most_analysed(all));
  std::ranges::reverse(estimators);
  for (const Estimator& estimator : estimators)
    add({element_name(quantity_of(estimator.member).name, estimator.element),
         "{/:Italic θ_d} (" + estimator.label + ")",
         "theta_d, " + estimator.meaning,
         {}},
        [&](const FigureRun& run) { return theta_d_of(run, estimator); });
  return angles;
}

HistogramBins bins_for(const std::vector<double>& values) {
  const Summary summary = summary_of(values, {});
  std::vector<double> numbers = values;
  std::erase_if(numbers, [](double value) { return std::isnan(value); });
  const auto [low, high] = std::ranges::minmax(numbers);
  double wanted = 2.0 * (summary.upper_quartile - summary.lower_quartile) /
                  std::cbrt(static_cast<double>(numbers.size()));
  wanted = std::max(wanted, (high - low) / static_cast<double>(most_bins) * 2.5);  // rounding may halve it
  if (!(wanted > 0.0)) wanted = 0.5;
  const double width = round_step(wanted);
  const double first = std::floor(low / width) - 1.0;
  return {first * width, width, static_cast<std::size_t>(std::floor(high / width) - first) + 2};
}

std::optional<Figure> angle_distributions(std::span<const RunGroup> groups) {
  const AngleGroups all = angle_groups(groups);
  if (all.angles.empty()) return std::nullopt;
  Figure figure;
  figure.name = "angle-distributions";
  figure.title = "Distribution of theta_c, theta_d and theta_r over the runs";
  figure.caption =
      "Histograms of the angles at which something happens in a run: theta_c, the first slide of the surface "
      "layer, the angle at rest theta_r where a flow was followed, and theta_d by each estimator: jump of "
      "the "
      "largest l_c, first cluster that spans from floor to surface, for each threshold, and onset of "
      "dilation by "
      "either strain. Shares are of the runs of a group that have the angle, n in number; vertical lines are "
      "the "
      "means, ± their standard errors.";
  add_angle_tables(figure, all);
  for (std::size_t k = 0; k < all.angles.size(); ++k) add_histogram(figure, all.angles[k], k + 1);
  const std::size_t rows = (all.angles.size() + panels_in_row - 1) / panels_in_row;
  set_variable(figure, "panels", static_cast<double>(all.angles.size()));
  set_variable(figure, "rows", static_cast<double>(rows));
  figure.wide = true;
  figure.height_over_width =
      static_cast<double>(rows) * (3.9 + 0.32 * static_cast<double>(all.groups.size())) / 17.8;
  return figure;
}

std::optional<Figure> angle_correlations(std::span<const RunGroup> groups) {
  AngleGroups all = angle_groups(groups);
  std::erase_if(all.angles, is_of_further_threshold);
  if (all.angles.size() < 2) return std::nullopt;
  Figure figure;
  figure.name = "angle-correlations";
  figure.title = "Correlation of theta_c, theta_d and theta_r over the runs";
  figure.caption =
      "Each angle at which something happens in a run over each other one, a point for each run that has "
      "both; r "
      "is Pearson's coefficient of correlation, given from three runs on. theta_d is that at the first "
      "threshold "
      "where it depends on one.";
  add_angle_tables(figure, all);
  figure.tables.push_back(coefficient_table(all.angles, all.groups.size()));
  set_coefficient_texts(figure, figure.tables.back(), all.groups.size());
  for (std::size_t k = 0; k < all.angles.size(); ++k) {
    set_range(figure, all.angles[k], k + 1);
    set_variable(figure, fmt::format("angle_{}", k + 1), gnuplot_string(all.angles[k].name));
    set_variable(figure, fmt::format("title_{}", k + 1), gnuplot_string(all.angles[k].label));
  }
  set_variable(figure, "angles", static_cast<double>(all.angles.size()));
  figure.wide = true;
  figure.height_over_width = 0.85;
  return figure;
}

}  // namespace talus
