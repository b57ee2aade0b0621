#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <vector>

#include "core/statistics.h"
#include "core/trigonometry.h"
#include "figures/group_table.h"
#include "figures/recipes.h"
#include "figures/run_means.h"
#include "figures/theta_d_estimators.h"
#include "pictures/texts.h"

namespace talus::figures {
namespace {

/// Returns a row for each estimator: theta_d as a mean over the runs that have one.
Table theta_d_table(const std::string& name, const RunChoice& runs,
                    const std::vector<Estimator>& estimators) {
  std::string meanings;
  for (std::size_t e = 0; e < estimators.size(); ++e)
    meanings += fmt::format("{}{} {}", e > 0 ? "; " : "", e + 1, estimators[e].meaning);
  Column estimator{"estimator", "1", meanings, {}};
  Column n{"n", "1", "runs that have a theta_d by this estimator", {}};
  Column mean{"theta_d", "deg", "theta_d, mean over these runs", {}};
  Column error{"theta_d_error", "deg", "its standard error over these runs", {}};
  for (std::size_t e = 0; e < estimators.size(); ++e) {
    std::vector<double> angles;
    for (const runs::RunView* run : runs) angles.push_back(theta_d_of(*run, estimators[e]));
    const Statistics result = statistics_of(angles);
    estimator.values.push_back(static_cast<double>(e + 1));
    n.values.push_back(result.count);
    mean.values.push_back(result.mean);
    error.values.push_back(result.error);
  }
  return {name, {std::move(estimator), std::move(n), std::move(mean), std::move(error)}};
}

/// The runs of a periodic group.
struct PeriodicRuns {
  std::string name;  ///< name of its table
  RunChoice runs;
};

/// Adds the strains of all periodic groups.
std::vector<PeriodicRuns> add_strains(Figure& figure, std::span<const RunGroup> groups) {
  const std::vector<FrameColumn> strains = {
      column_of("volume_strain", analysis::quantity_of(&analysis::FrameRecord::volume_strain)),
      column_of("centre_of_mass_strain",
                analysis::quantity_of(&analysis::FrameRecord::centre_of_mass_strain))};
  std::vector<PeriodicRuns> chosen;
  for (const RunGroup& group : groups) {
    if (!group.periodic()) continue;
    chosen.push_back({table_name(group), all_runs(group)});
    add_group_curves(figure, group, chosen.back().runs, strains);
  }
  return chosen;
}

/// Returns the tick spacing of the axis of a strain, in 1e-3; a panel has room for about six ticks.
double tick_step(const Figure& figure, const std::string& strain) {
  double low = 0.0, high = 0.0;
  for (const Table& table : figure.tables)
    for (const Column& column : table.columns)
      if (column.name == strain)
        for (const double value : column.values)
          if (!std::isnan(value)) low = std::min(low, value), high = std::max(high, value);
  return high > low ? pictures::round_step(1000.0 * (high - low), 5) : 1.0;
}

}  // namespace

std::optional<Figure> volume_strain_figure(std::span<const RunGroup> groups) {
  Figure figure;
  figure.name = "fig14-volume-strain";
  figure.title = "Volume strain over tilt, and theta_d by each estimator (paper, Fig. 14)";
  figure.caption =
      "Strain of periodic beds since the start of the tilt: (a) of the volume below the free surface, (b) of "
      "the height of the centre of mass; negative: contraction. (c) theta_d by each estimator, mean and "
      "standard error over the runs that have one: jump of the largest l_c and first cluster that spans from "
      "floor to surface, for each threshold, and onset of dilation by either strain; dashed: the paper's 15 "
      "deg.";
  figure.caption.append(" ").append(means_caption);
  figure.height_over_width = 1.35;
  const std::vector<PeriodicRuns> chosen = add_strains(figure, groups);
  if (chosen.empty()) return std::nullopt;
  for (const char* strain : {"volume_strain", "centre_of_mass_strain"})
    set_variable(figure, fmt::format("step_{}", strain), tick_step(figure, strain));
  RunChoice all;
  for (const PeriodicRuns& group : chosen) all.insert(all.end(), group.runs.begin(), group.runs.end());
  const std::vector<Estimator> estimators = estimators_of(max_analysed(all));
  set_variable(figure, "estimators", static_cast<double>(estimators.size()));
  for (std::size_t e = 0; e < estimators.size(); ++e)
    set_variable(figure, fmt::format("estimator_{}", e + 1), gnuplot_string(estimators[e].label));
  for (std::size_t g = 0; g < chosen.size(); ++g) {
    figure.tables.push_back(theta_d_table("theta_d-" + chosen[g].name, chosen[g].runs, estimators));
    set_variable(figure, fmt::format("theta_d_{}", g + 1),
                 gnuplot_string(file_of(figure, figure.tables.back())));
  }
  return figure;
}

}  // namespace talus::figures
