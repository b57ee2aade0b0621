#include <cmath>
#include <fmt/core.h>
#include <string>

#include "analysis/topology/topology.h"
#include "core/trigonometry.h"
#include "figures/failed_group.h"
#include "figures/recipes.h"

namespace talus::figures {
namespace {

/// Returns the diagram of the components of a frame. Loops are left out because they all die at 0.
Table diagram_table(const runs::RunView& run, const std::string& state, std::size_t frame) {
  const analysis::PersistenceDiagram diagram = analysis::force_persistence(
      {run.file->frame(frame), run.file->header().statics}, run.analysis.frames.at(frame).mean_normal_force);
  Table table{state,
              {{"birth", "1", "largest normal force in a component, over the mean", {}},
               {"death", "1", "force at which it meets an older one, or 0", {}}}};
  for (const analysis::Lifetime& lifetime : diagram.components) {
    table.columns[0].values.push_back(lifetime.birth);
    table.columns[1].values.push_back(lifetime.death);
  }
  return table;
}

Table curve_table(const runs::RunView& run) {
  Table table{"",
              {{"theta", "deg", "magnitude of the tilt", {}},
               {"components", "1", "total persistence of components, per grain", {}},
               {"loops", "1", "total persistence of loops, per grain", {}},
               {"components_change", "1", "distance of component diagrams from the preceding frame", {}},
               {"loops_change", "1", "distance of loop diagrams from the preceding frame", {}}}};
  const analysis::FramesOfRise rise = runs::last_rise_of(run);
  for (std::size_t k = 0; k < rise.frames.size(); ++k) {
    const analysis::FrameRecord& frame = *rise.frames[k];
    const double row[] = {degrees(rise.tilts[k]), frame.component_persistence, frame.loop_persistence,
                          frame.network_change[0], frame.network_change[1]};
    for (std::size_t c = 0; c < std::size(row); ++c) table.columns[c].values.push_back(row[c]);
  }
  return table;
}

}  // namespace

std::optional<Figure> persistence_figure(std::span<const RunGroup> groups) {
  const auto failed = first_failed_group(groups);
  if (!failed) return std::nullopt;
  const runs::RunView& run = failed->first();
  const std::size_t repose = repose_frame(run);
  Figure figure;
  figure.name = "persistence";
  figure.title = "Persistence of the force network";
  figure.caption = fmt::format(
      "The network of the contacts of {} whose normal force is at least a threshold, as the threshold falls, "
      "in units of the mean force. (a) Its components, dots, of the first frame and of the last before "
      "theta_c: each is born at the largest force in it, and dies when it meets an older one. (b) Sum of "
      "birth - death of the components and of the loops, per grain; loops last down to 0. (c) Distance of "
      "the diagrams of each frame from those of the preceding frame, per grain; the dashed line is theta_c.",
      first_run_text(*failed));
  figure.runs = {run.path};
  figure.wide = true;
  figure.height_over_width = 0.36;
  figure.tables = {curve_table(run), diagram_table(run, "start", 0), diagram_table(run, "repose", repose)};
  set_variable(figure, "theta_c", degrees(run.analysis.theta_c));
  for (const auto& [name, frame] : {std::pair{"theta_start", std::size_t{0}}, {"theta_repose", repose}})
    set_variable(figure, name, gnuplot_quoted(angle_text(std::abs(run.analysis.frames[frame].tilt))));
  return figure;
}

}  // namespace talus::figures
