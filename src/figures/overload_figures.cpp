#include <algorithm>
#include <fmt/core.h>

#include "figures/group_table.h"
#include "figures/recipes.h"
#include "figures/run_means.h"
#include "scenario/text.h"

namespace talus::figures {
namespace {

/// Returns the factors of the thresholds over Gamma_c as text; they are the same in all runs.
std::vector<std::string> factors_of(const runs::RunView& run) {
  std::vector<std::string> factors;
  for (const analysis::RunThreshold& threshold : run.analysis.thresholds)
    factors.push_back(scenario::short_text(threshold.factor));
  return factors;
}

/// Returns the label of a threshold, such as "Gamma_c" or "2 Gamma_c", in enhanced text.
std::string threshold_label(const std::string& factor) {
  return fmt::format("'{{/:Italic γ}} ≥ {}Γ_c'", factor == "1" ? "" : factor + " ");
}

/// Returns the column of a quantity at threshold f, which is `factor` Gamma_c.
FrameColumn threshold_column(const std::string& name, const analysis::QuantityMember& member,
                             const std::string& factor, std::size_t f) {
  FrameColumn column = column_of(fmt::format("{}_{}", name, factor), analysis::quantity_of(member), f);
  column.meaning += fmt::format(", for gamma >= {} Gamma_c", factor);
  return column;
}

/// Quantities by the names of their columns.
using NamedMembers = std::vector<std::pair<std::string, analysis::QuantityMember>>;

/// Adds the tables of periodic beds, with these columns for each threshold.
void add_periodic_groups(Figure& figure, std::span<const RunGroup> groups, const NamedMembers& members) {
  for (const RunGroup& group : groups) {
    const RunChoice runs = runs_with_threshold(group);
    if (!group.periodic() || runs.empty()) continue;
    const std::vector<std::string> factors = factors_of(*runs.front());
    std::vector<FrameColumn> all;
    for (std::size_t f = 0; f < factors.size(); ++f) {
      for (const auto& [name, member] : members) all.push_back(threshold_column(name, member, factors[f], f));
      set_variable(figure, fmt::format("factor_{}", f + 1), gnuplot_string(factors[f]));
      set_variable(figure, fmt::format("threshold_{}", f + 1), threshold_label(factors[f]));
    }
    set_variable(figure, "thresholds", static_cast<double>(factors.size()));
    if (figure.tables.empty()) figure.caption.append(" ").append(reading_caption(*runs.front()));
    add_group_curves(figure, group, runs, all);
  }
}

Column tilts_of_the_paper() { return {"theta", "deg", "tilt", {0.0, 15.0, 20.0}}; }

constexpr std::string_view paper_text =
    " Crosses: the paper's values at 0, theta_d = 15 deg and theta_c = 20 deg, the middle of its range of "
    "19 to 21 deg, in each panel.";

}  // namespace

std::optional<Figure> overloaded_fraction_figure(std::span<const RunGroup> groups) {
  Figure figure;
  figure.name = "fig09-overloaded-fraction";
  figure.title = "Overloaded fraction over tilt (paper, Fig. 9)";
  figure.wide = true;
  figure.height_over_width = 0.42;
  figure.caption =
      "Fraction p_o of overloaded grains among those that carry something over the tilt theta, for each "
      "threshold: gamma >= Gamma_c = sin(theta_c) as printed in the paper, and multiples of it.";
  figure.caption.append(paper_text).append(" ").append(means_caption);
  add_periodic_groups(figure, groups, {{"p_o", &analysis::FrameThreshold::overloaded_fraction}});
  if (figure.tables.empty()) return std::nullopt;
  figure.tables.push_back(
      {"paper", {tilts_of_the_paper(), {"p_o", "1", "overloaded fraction", {0.30, 0.45, 0.60}}}});
  return figure;
}

std::optional<Figure> length_figure(std::span<const RunGroup> groups) {
  Figure figure;
  figure.name = "fig12-coarse-graining-length";
  figure.title = "Coarse-graining length of overloaded grains over tilt (paper, Fig. 12)";
  figure.wide = true;
  figure.height_over_width = 0.7;
  figure.caption =
      "Coarse-graining length l_c, a diameter, of the overloaded grains over the tilt theta, with a panel "
      "for each threshold: first the mean, then the largest. Dashed lines: the cut of each bed at which the "
      "search for l_c ends.";
  figure.caption.append(paper_text).append(" ").append(means_caption);
  add_periodic_groups(
      figure, groups,
      {{"mean", &analysis::FrameThreshold::lc_mean}, {"max", &analysis::FrameThreshold::lc_max}});
  if (figure.tables.empty()) return std::nullopt;
  double top = 30.0;  // upper end of the axis of the largest lengths
  int shown = 0;
  for (const RunGroup& group : groups) {
    const RunChoice runs = group.periodic() ? runs_with_threshold(group) : RunChoice{};
    if (runs.empty()) continue;
    double cut = 0.0;
    for (const runs::RunView* run : runs)
      cut = std::max(cut, run->analysis.lc_cut / run->statics.mean_diameter);
    set_variable(figure, fmt::format("cut_{}", ++shown), cut);
    top = std::max(top, cut);
  }
  set_variable(figure, "top", top);
  figure.tables.push_back({"paper",
                           {tilts_of_the_paper(),
                            {"mean", "D", "mean l_c", {4.0, 5.0, 7.0}},
                            {"max", "D", "largest l_c", {5.0, 15.0, 30.0}}}});
  return figure;
}

}  // namespace talus::figures
