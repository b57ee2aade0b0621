#include "figures/volume_strain_figure.h"

#include <cmath>
#include <vector>

#include "core/trigonometry.h"
#include "figures/group_table.h"
#include "figures/run_means.h"
#include "session/scenario_text.h"
#include "session/study_statistics.h"

namespace talus {
namespace {

/// An estimator of theta_d: a data set, which of its elements, and how it is called.
struct Estimator {
  std::string_view data_set;
  std::size_t element;
  std::string label;    ///< for the axis, in enhanced text
  std::string meaning;  ///< for the table
};

std::string times_gamma_c(double factor, const char* gamma_c) {
  return (factor == 1.0 ? "" : short_text(factor) + " ").append(gamma_c);
}

/// All estimators that a run has, from the bottom of the panel to its top.
std::vector<Estimator> estimators_of(const FigureRun& run) {
  std::vector<Estimator> estimators = {
      {"theta_d/dilation", 1, "{/:Italic ε_y}", "onset of dilation, centre of mass"},
      {"theta_d/dilation", 0, "{/:Italic ε_V}", "onset of dilation, free surface"}};
  if (run.analysis.sizes.at('F') == 0) return estimators;
  const auto factors = values<double>(run.analysis, "threshold_factor");
  for (std::size_t f = factors.size(); f-- > 0;)
    estimators.push_back({"theta_d/percolation", f, "span, " + times_gamma_c(factors[f], "Γ_c"),
                          "percolation at " + times_gamma_c(factors[f], "Gamma_c")});
  for (std::size_t f = factors.size(); f-- > 0;)
    estimators.push_back({"theta_d/lc_jump", f, "{/:Italic ℓ_c}, " + times_gamma_c(factors[f], "Γ_c"),
                          "jump of the largest l_c at " + times_gamma_c(factors[f], "Gamma_c")});
  return estimators;
}

/// deg; NaN where the run has none.
double theta_d_of(const FigureRun& run, const Estimator& estimator) {
  if (!run.analysis.data_sets.contains(estimator.data_set)) return std::nan("");
  return degrees(values<double>(run.analysis, estimator.data_set)[estimator.element]);
}

/// A row for each estimator: theta_d as a mean over the runs that have one.
Table theta_d_table(const std::string& name, const RunChoice& runs,
                    const std::vector<Estimator>& estimators) {
  std::string meanings;
  for (std::size_t e = 0; e < estimators.size(); ++e)
    meanings += (e > 0 ? "; " : "") + std::to_string(e + 1) + " " + estimators[e].meaning;
  Column estimator{"estimator", "1", meanings, {}};
  Column n{"n", "1", "runs that have a theta_d by this estimator", {}};
  Column mean{"theta_d", "deg", "theta_d, mean over these runs", {}};
  Column error{"theta_d_error", "deg", "its standard error over these runs", {}};
  for (std::size_t e = 0; e < estimators.size(); ++e) {
    std::vector<double> angles;
    for (const FigureRun* run : runs) angles.push_back(theta_d_of(*run, estimators[e]));
    const MeanError result = mean_error(angles);
    estimator.values.push_back(static_cast<double>(e + 1));
    n.values.push_back(result.count);
    mean.values.push_back(result.mean);
    error.values.push_back(result.error);
  }
  return {name, {std::move(estimator), std::move(n), std::move(mean), std::move(error)}};
}

Quantity strain(const std::string& name, const std::string& meaning, const std::string& data_set) {
  return {name, "1", meaning, [data_set](const FigureRun& run, std::size_t frame) {
            return values<double>(run.analysis, data_set)[frame];
          }};
}

/// Adds the strains of all periodic groups; returns the runs of each.
std::vector<RunChoice> add_strains(Figure& figure, std::span<const RunGroup> groups) {
  const std::vector<Quantity> strains = {
      strain("volume_strain", "(V - V0)/V0, V from the free surface", "packing/volume_strain"),
      strain("centre_of_mass_strain", "(y - y0)/y0, y the height of the centre of mass",
             "packing/centre_of_mass_strain")};
  std::vector<RunChoice> chosen;
  for (const RunGroup& group : groups) {
    if (!group.periodic()) continue;
    chosen.push_back(all_runs(group));
    add_group_table(figure, group, chosen.back(), means_over_runs(chosen.back(), strains));
  }
  set_more_keys(figure, 0);
  return chosen;
}

/// A run with thresholds, if there is one: it has all estimators.
const FigureRun& most_analysed(const std::vector<RunChoice>& chosen) {
  for (const RunChoice& runs : chosen)
    for (const FigureRun* run : runs)
      if (run->analysis.sizes.at('F') > 0) return *run;
  return *chosen.front().front();
}

}  // namespace

std::optional<Figure> volume_strain_figure(std::span<const RunGroup> groups) {
  Figure figure;
  figure.name = "fig14-volume-strain";
  figure.title = "Volume strain over tilt, and theta_d by each estimator (paper, Fig. 14)";
  figure.caption =
      "Strain of periodic beds since the start of the tilt: (a) of the volume below the free surface, (b) of "
      "the "
      "height of the centre of mass; negative: contraction. (c) theta_d by each estimator, mean and standard "
      "error over the runs that have one: jump of the largest l_c and first cluster that spans from floor to "
      "surface, for each threshold, and onset of dilation by either strain; dashed: the paper's 15 deg.";
  figure.caption.append(" ").append(means_caption);
  figure.height_over_width = 1.35;
  const std::vector<RunChoice> chosen = add_strains(figure, groups);
  if (chosen.empty()) return std::nullopt;
  const std::vector<Estimator> estimators = estimators_of(most_analysed(chosen));
  set_variable(figure, "estimators", static_cast<double>(estimators.size()));
  for (std::size_t e = 0; e < estimators.size(); ++e)
    set_variable(figure, "estimator_" + std::to_string(e + 1), gnuplot_string(estimators[e].label));
  for (std::size_t g = 0; g < chosen.size(); ++g) {
    const std::string name = "theta_d-" + figure.tables[g].name;
    figure.tables.push_back(theta_d_table(name, chosen[g], estimators));
    set_variable(figure, "theta_d_" + std::to_string(g + 1),
                 gnuplot_string(file_of(figure, figure.tables.back())));
  }
  return figure;
}

}  // namespace talus
