#include "figures/group_table.h"
#include "figures/recipes.h"
#include "figures/run_means.h"

namespace talus::figures {
namespace {

/// Adds a quantity of frames for all groups to a figure.
std::optional<Figure> over_tilt(Figure figure, std::span<const RunGroup> groups,
                                const analysis::Quantity& quantity) {
  if (groups.empty()) return std::nullopt;
  for (const RunGroup& group : groups) {
    const RunChoice runs = all_runs(group);
    const FrameColumn column = column_of("ratio", quantity);
    add_group_curves(figure, group, runs, {&column, 1});
  }
  figure.caption.append(" ").append(means_caption);
  return figure;
}

}  // namespace

std::optional<Figure> shear_stress_figure(std::span<const RunGroup> groups) {
  Figure figure;
  figure.name = "fig04-shear-stress";
  figure.title = "Normalised shear stress against tan(theta) (paper, Fig. 4)";
  figure.caption =
      "Shear over normal stress of the packing, sigma_T / sigma_N, over the tangent of the tilt theta, up to "
      "theta_c. Dotted: sigma_T / sigma_N = tan(theta), equilibrium of a periodic bed (paper, Eq. 10).";
  return over_tilt(std::move(figure), groups, analysis::quantity_of(&analysis::FrameRecord::sigma_t_over_n));
}

std::optional<Figure> stress_ratio_figure(std::span<const RunGroup> groups) {
  Figure figure;
  figure.name = "fig05-stress-ratio";
  figure.title = "Stress ratio of the packing against sin(theta) (paper, Fig. 5)";
  figure.caption =
      "Stress ratio Gamma = Q/P of the packing over the sine of the tilt theta, up to theta_c. Dotted: Gamma "
      "= sin(theta), the least value for a periodic bed in equilibrium (paper, Eq. 11).";
  return over_tilt(std::move(figure), groups, analysis::quantity_of(&analysis::FrameRecord::stress_ratio));
}

}  // namespace talus::figures
