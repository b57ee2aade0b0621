#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "analysis/contacts/weak_contacts.h"
#include "base/text.h"
#include "core/statistics.h"
#include "core/trigonometry.h"
#include "figures/failed_group.h"
#include "figures/recipes.h"
#include "figures/run_means.h"

namespace talus::figures {
namespace {

/// Default states of the comparison.
const FrameWords both_ends = {"frame0", "repose"};

using States = std::span<const ShownFrames>;

/// Adds the means of a quantity in each state to a table.
void add_means(Table& table, States states, std::vector<double> analysis::FrameRecord::*member,
               const Column& column) {
  for (const ShownFrames& state : states)
    for (Column& mean :
         row_means(state.at.runs, state.at.frames, member,
                   {column.name + "_" + state.name, column.unit, column.meaning + " " + state.text, {}}))
      table.columns.push_back(std::move(mean));
}

/// Returns a figure of these runs, with the names of the states and their angles for its script.
Figure figure_of(const FailedGroup& failed, States states) {
  Figure figure;
  for (const runs::RunView* run : failed.runs) figure.runs.push_back(run->path);
  set_variable(figure, "states", gnuplot_string(joined(states, " ", &ShownFrames::name)));
  set_variable(figure, "tilts", gnuplot_string(joined(states, " ", [](const ShownFrames& state) {
                 return angle_text(mean_tilt(state.at));
               })));
  return figure;
}

std::string states_text(const FailedGroup& failed, States states) {
  const bool several = failed.runs.size() > 1;
  return fmt::format(" {}: {}{} of {}",
                     joined(states, ", ",
                            [&](const ShownFrames& state) {
                              return fmt::format("{} (theta = {} deg{})", state.text,
                                                 angle_text(mean_tilt(state.at)),
                                                 several ? " in the mean" : "");
                            }),
                     several ? "mean of " : "", runs_text(failed.runs.size()), failed.group->label);
}

constexpr const char* error_text = ", with standard errors over the runs as bars if there are several";

/// Returns the lower and upper edges of bins, in units of `unit`.
std::vector<Column> edge_columns(std::span<const double> edges, double unit, const Column& axis) {
  Column from{axis.name + "_from", axis.unit, "lower edge of a bin of " + axis.meaning, {}};
  Column to{axis.name + "_to", axis.unit, "its upper edge", {}};
  for (std::size_t b = 0; b + 1 < edges.size(); ++b) {
    from.values.push_back(edges[b] / unit);
    to.values.push_back(edges[b + 1] / unit);
  }
  return {from, to};
}

}  // namespace

std::vector<Column> row_means(const RunChoice& runs, std::span<const std::size_t> frames,
                              std::vector<double> analysis::FrameRecord::*member, Column mean) {
  Column error{mean.name + "_error", mean.unit, "its standard error over the runs", {}};
  const std::size_t width = (runs.front()->analysis.frames.at(frames[0]).*member).size();
  for (std::size_t k = 0; k < width; ++k) {
    std::vector<double> elements;
    for (std::size_t r = 0; r < runs.size(); ++r)
      elements.push_back((runs[r]->analysis.frames.at(frames[r]).*member)[k]);
    const Statistics result = statistics_of(elements);
    mean.values.push_back(result.mean);
    error.values.push_back(result.error);
  }
  return {std::move(mean), std::move(error)};
}

std::optional<Figure> contact_directions(std::span<const RunGroup> groups, const FrameWords& at) {
  const auto failed = first_group_with_distributions(groups);
  if (!failed) return std::nullopt;
  const std::vector<ShownFrames> states = shown_frames(failed->runs, at, both_ends);
  Figure figure = figure_of(*failed, states);
  figure.name = "contact-directions";
  figure.title = "Directions of contact normals";
  figure.caption = fmt::format(
      "Probability density of the direction of contact normals, relative to the bed,{}. Filled: each contact "
      "counted once; outlined: weighted with its normal force; thin circle: uniform, 1/pi per rad. A normal "
      "and its opposite are one direction; 0, 60 and 120 deg are marked.",
      states_text(*failed, states));
  figure.wide = true;
  figure.height_over_width = 0.48 * std::ceil(0.5 * static_cast<double>(states.size()));
  const std::vector<double>& edges = failed->first().analysis.direction_edge;
  Table table{"", edge_columns(edges, radians(1.0), {"direction", "deg", "the direction to the bed", {}})};
  add_means(table, states, &analysis::FrameRecord::direction_density,
            {"density", "1/rad", "probability density of the direction", {}});
  add_means(table, states, &analysis::FrameRecord::direction_density_by_force,
            {"by_force", "1/rad", "the same, contacts weighted with f_n,", {}});
  figure.tables = {std::move(table)};
  return figure;
}

std::optional<Figure> force_distribution(std::span<const RunGroup> groups, const FrameWords& at) {
  const auto failed = first_group_with_distributions(groups);
  if (!failed) return std::nullopt;
  const std::vector<ShownFrames> states = shown_frames(failed->runs, at, both_ends);
  Figure figure = figure_of(*failed, states);
  figure.name = "force-distribution";
  figure.title = "Distribution of the normal forces";
  figure.caption = fmt::format(
      "Probability density of the normal force f over its mean <f>,{}{}; (a) semilogarithmic, (b) double "
      "logarithmic.",
      states_text(*failed, states), error_text);
  figure.wide = true;
  figure.height_over_width = 0.4;
  const std::vector<double>& edges = failed->first().analysis.force_edge;
  Table table{"", edge_columns(edges, 1.0, {"force", "1", "the normal force over its mean", {}})};
  add_means(table, states, &analysis::FrameRecord::force_density,
            {"density", "1", "probability density of f over <f>", {}});
  figure.tables = {std::move(table)};
  return figure;
}

std::optional<Figure> correlations(std::span<const RunGroup> groups, const FrameWords& at) {
  const auto failed = first_group_with_distributions(groups);
  if (!failed) return std::nullopt;
  const std::vector<ShownFrames> states = shown_frames(failed->runs, at, both_ends);
  Figure figure = figure_of(*failed, states);
  figure.name = "correlations";
  figure.title = "Correlation of forces and stresses over distance";
  figure.caption = fmt::format(
      "Correlation of the normal forces, of the stress ratio gamma of grains and of their mean stress, over "
      "distance,{}{}. Forces and mean stresses are divided by the mean of their layer of 2 D.",
      states_text(*failed, states), error_text);
  figure.wide = true;
  figure.height_over_width = 0.4;
  Column distance{"r", "D", "distance between two contact points, or two centres", {}};
  for (const double r : failed->first().analysis.correlation_distance)
    distance.values.push_back(r / failed->first().statics.mean_diameter);
  Table table{"", {std::move(distance)}};
  add_means(table, states, &analysis::FrameRecord::normal_force_correlation,
            {"force", "1", "correlation of normal forces", {}});
  add_means(table, states, &analysis::FrameRecord::gamma_correlation,
            {"gamma", "1", "correlation of gamma", {}});
  add_means(table, states, &analysis::FrameRecord::mean_stress_correlation,
            {"stress", "1", "correlation of the mean stress of grains", {}});
  figure.tables = {std::move(table)};
  return figure;
}

std::optional<Figure> weak_contacts_figure(std::span<const RunGroup> groups, const FrameWords& at) {
  const auto failed = first_group_with_distributions(groups);
  if (!failed) return std::nullopt;
  const std::vector<ShownFrames> states = shown_frames(failed->runs, at, both_ends);
  Figure figure = figure_of(*failed, states);
  figure.name = "weak-contacts";
  figure.title = "Directions of weak contacts over their mobilised friction";
  figure.caption = fmt::format(
      "Fabric of the weak contacts (normal force up to its mean) along the strong ones, 2 <cos 2 (direction "
      "- d)>, d the direction in which the strong contacts concentrate, over their mobilised friction,{}{}. "
      "Below 0 they lie across the force chains. Weak contacts right of the dashed line count as coherent.",
      states_text(*failed, states), error_text);
  figure.height_over_width = 0.7;
  const std::vector<double>& edges = failed->first().analysis.mobilisation_edge;
  Table table{"", edge_columns(edges, 1.0, {"mobilised", "1", "the mobilised friction", {}})};
  add_means(table, states, &analysis::FrameRecord::weak_fabric_by_friction,
            {"fabric", "1", "fabric of weak contacts along the strong ones", {}});
  figure.tables = {std::move(table)};
  set_variable(figure, "coherent", analysis::coherent_mobilisation);
  return figure;
}

}  // namespace talus::figures
