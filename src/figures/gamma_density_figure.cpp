#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "core/statistics.h"
#include "figures/group_table.h"
#include "figures/recipes.h"
#include "figures/run_means.h"

namespace talus::figures {
namespace {

const FrameWords paper_angles = {"0", "10", "15"};

/// Returns gamma and its density in each of the frames that at least half of the runs reach.
std::vector<Column> density_columns(const RunChoice& runs, std::span<const ShownFrames> shown) {
  Column gamma{"gamma", "1", "middle of the bin", {}};
  const std::vector<double>& edges = runs.front()->analysis.gamma_edge;
  for (std::size_t b = 0; b + 1 < edges.size(); ++b) gamma.values.push_back(0.5 * (edges[b] + edges[b + 1]));
  std::vector<Column> columns = {std::move(gamma)};
  for (const ShownFrames& frames : shown) {
    const std::string meaning = fmt::format("probability density of gamma {}, ", frames.text);
    Column mean{"density_" + frames.name, "1", meaning + runs_text(frames.at.runs.size()), {}};
    if (2 * frames.at.runs.size() >= runs.size()) {
      for (Column& column : row_means(frames.at.runs, frames.at.frames, &analysis::FrameRecord::gamma_density,
                                      std::move(mean)))
        columns.push_back(std::move(column));
    } else {
      mean.values.assign(edges.size() - 1, std::nan(""));
      columns.push_back(mean);
      mean.name += "_error";
      columns.push_back(std::move(mean));
    }
  }
  return columns;
}

double mean_gamma_c(const RunChoice& runs) {
  std::vector<double> all;
  for (const runs::RunView* run : runs) all.push_back(run->analysis.gamma_c);
  return statistics_of(all).mean;
}

/// Whether any bed has a density in the frames of this name.
bool is_shown(const Figure& figure, const std::string& name) {
  return std::ranges::any_of(figure.tables, [&](const Table& table) {
    return std::ranges::any_of(table.columns, [&](const Column& column) {
      return column.name == "density_" + name &&
             std::ranges::any_of(column.values, [](double value) { return !std::isnan(value); });
    });
  });
}

}  // namespace

std::optional<Figure> gamma_density_figure(std::span<const RunGroup> groups, const FrameWords& at) {
  Figure figure;
  std::vector<ShownFrames> shown;
  figure.name = "fig08-stress-ratio-density";
  figure.title = "Distribution of the stress ratio of grains (paper, Fig. 8)";
  figure.caption =
      "Probability density of the stress ratio gamma = q/p of the grains that carry something, periodic "
      "beds; vertical lines: Gamma_c = sin(theta_c), the threshold printed in the paper, and 2 Gamma_c, each "
      "the mean over the runs. Means over the runs of a bed, at angles that at least half of them reach; "
      "bands: standard error of the mean, if there are several runs.";
  for (const RunGroup& group : groups) {
    const RunChoice runs = with_distributions(runs_with_threshold(group));
    if (!group.periodic() || runs.empty()) continue;
    if (figure.tables.empty()) figure.caption.append(" ").append(reading_caption(*runs.front()));
    shown = shown_frames(runs, at, paper_angles);
    add_group_table(figure, group, runs, density_columns(runs, shown));
    set_variable(figure, fmt::format("gamma_c_{}", figure.groups), mean_gamma_c(runs));
    set_variable(figure, fmt::format("several_{}", figure.groups), runs.size() > 1 ? 1.0 : 0.0);
  }
  if (figure.tables.empty()) return std::nullopt;
  std::erase_if(shown, [&](const ShownFrames& frames) { return !is_shown(figure, frames.name); });
  set_shown_frames(figure, shown);
  figure.height_over_width = 0.7 * static_cast<double>(figure.groups);
  return figure;
}

}  // namespace talus::figures
