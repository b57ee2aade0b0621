#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <iterator>

#include "core/statistics.h"
#include "figures/recipes.h"

namespace talus::figures {
namespace {

/// Whether the angle depends on a threshold other than the first.
bool is_of_further_threshold(const RunAngle& angle) {
  return angle.name.ends_with(']') &&
         !angle.name.starts_with(analysis::quantity_of(&analysis::Analysis::dilation).name);
}

/// Returns the height of the triangle of panels in a figure 17.8 cm wide, cm, for `rows` rows of panels with
/// `lines` lines of text above each. The script contains the same formula.
double triangle_height(std::size_t rows, std::size_t lines) {
  const double panel = 0.8 * (17.8 - 1.75) / static_cast<double>(rows);
  return static_cast<double>(rows) * (panel + 0.12 + 0.28 * static_cast<double>(lines)) + 1.2;
}

/// Returns the coefficients of all pairs, in the order of the panels.
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

/// Sets the range of an axis to all values of an angle, with room at both ends.
void set_range(Figure& figure, const RunAngle& angle, std::size_t k) {
  std::vector<double> numbers;
  for (const std::vector<double>& group_values : angle.values)
    std::ranges::copy_if(group_values, std::back_inserter(numbers),
                         [](double value) { return !std::isnan(value); });
  const auto [low, high] = std::ranges::minmax(numbers);
  const double room = high > low ? 0.08 * (high - low) : 0.5;
  set_variable(figure, fmt::format("low_{}", k), low - room);
  set_variable(figure, fmt::format("high_{}", k), high + room);
  set_variable(figure, fmt::format("step_{}", k), round_step(0.4 * (high - low + 2.0 * room)));
}

/// Sets "r = 0.42", or nothing, for each row of the coefficients of a group, and the line above a panel,
/// counted from 1, for the texts of the group. Returns the number of groups with a coefficient.
std::size_t set_coefficient_texts(Figure& figure, const Table& table, std::size_t groups) {
  const std::vector<double>&first = table.columns[0].values, &second = table.columns[1].values;
  std::size_t lines = 0;
  for (std::size_t g = 0; g < groups; ++g) {
    const std::vector<double>& r = table.columns[2 * g + 2].values;
    if (std::ranges::any_of(r, [](double value) { return !std::isnan(value); })) ++lines;
    set_variable(figure, fmt::format("line_{}", g + 1), static_cast<double>(lines));
    for (std::size_t row = 0; row < r.size(); ++row)
      set_variable(figure, fmt::format("r_{:.0f}_{:.0f}_{}", first[row], second[row], g + 1),
                   gnuplot_string(std::isnan(r[row]) ? std::string()
                                                     : fmt::format("{{/:Italic r}} = {:.2f}", r[row])));
  }
  set_variable(figure, "lines", static_cast<double>(lines));
  return lines;
}

}  // namespace

std::optional<Figure> angle_correlations(std::span<const RunGroup> groups) {
  AngleGroups all = angle_groups(groups);
  std::erase_if(all.angles, is_of_further_threshold);
  if (all.angles.size() < 2) return std::nullopt;
  Figure figure;
  figure.name = "angle-correlations";
  figure.title = "Correlation of theta_c, theta_d and theta_r over the runs";
  figure.caption =
      "Each characteristic angle of a run over each other one, with a point for each run that has both; r is "
      "Pearson's correlation coefficient, given for at least three runs. theta_d is that at the first "
      "threshold if it depends on one.";
  add_angle_tables(figure, all);
  figure.tables.push_back(coefficient_table(all.angles, all.groups.size()));
  const std::size_t lines = set_coefficient_texts(figure, figure.tables.back(), all.groups.size());
  for (std::size_t k = 0; k < all.angles.size(); ++k) {
    set_range(figure, all.angles[k], k + 1);
    set_variable(figure, fmt::format("angle_{}", k + 1), gnuplot_string(all.angles[k].name));
    set_variable(figure, fmt::format("title_{}", k + 1), gnuplot_string(all.angles[k].label));
  }
  set_variable(figure, "angles", static_cast<double>(all.angles.size()));
  figure.wide = true;
  figure.height_over_width = triangle_height(all.angles.size() - 1, lines) / 17.8;
  return figure;
}

}  // namespace talus::figures
