#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "core/statistics.h"
#include "ensemble/plus_minus.h"
#include "figures/recipes.h"

namespace talus::figures {
namespace {

constexpr std::size_t max_bins = 60;
constexpr std::size_t panels_in_row = 3;

/// Returns a summary: "mean 19.16 ± 0.09, median 19.17, n = 50".
std::string summary_text(const std::vector<double>& values) {
  const Summary summary = summary_of(values);
  const Statistics& found = summary.statistics;
  if (found.count == 0) return "none";
  const std::string mean = found.count > 1 && found.error > 0.0
                               ? ensemble::plus_minus(found.mean, found.error)
                               : fmt::format("{:.2f}", found.mean);
  return fmt::format("mean {}, median {:.2f}, n = {}", mean, summary.median, found.count);
}

/// Returns the share of the runs of each group in each bin.
Table histogram_table(const RunAngle& angle) {
  std::vector<double> together;
  for (const std::vector<double>& group_values : angle.values)
    together.insert(together.end(), group_values.begin(), group_values.end());
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
            1.0 / statistics_of(angle.values[g]).count;
    table.columns.push_back(std::move(share));
  }
  return table;
}

/// Adds the histograms of one angle, with their title and summaries.
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

}  // namespace

HistogramBins bins_for(const std::vector<double>& values) {
  const Summary summary = summary_of(values);
  std::vector<double> numbers = values;
  std::erase_if(numbers, [](double value) { return std::isnan(value); });
  const auto [low, high] = std::ranges::minmax(numbers);
  double wanted = 2.0 * (summary.upper_quartile - summary.lower_quartile) /
                  std::cbrt(static_cast<double>(numbers.size()));
  // Rounding may halve the width.
  wanted = std::max(wanted, (high - low) / static_cast<double>(max_bins) * 2.5);
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
      "Histograms of the characteristic angles of a run: theta_c, the first slide of the surface layer "
      "(after theta_c if the tilt is fast compared with the acceleration of the flow), the angle at rest "
      "theta_r if a flow was followed, and theta_d by each estimator: jump of the largest l_c, first cluster "
      "that spans from floor to surface, for each threshold, and onset of dilation by either strain. Shares "
      "refer to the n runs of a group that have the angle; vertical lines are the means, ± their standard "
      "errors.";
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

}  // namespace talus::figures
