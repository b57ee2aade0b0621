#include <algorithm>
#include <cmath>

#include "core/trigonometry.h"
#include "gui/panels.h"
#include "gui/plot_widget.h"

namespace talus {
namespace {

/// Plots as wide as they can be read, and as high as there is room, in rows.
struct PlotGrid {
  int columns = 1;
  ImVec2 cell;
};

PlotGrid lay_out_plots(const ImVec2& room, int count, float em) {
  PlotGrid grid;
  grid.columns = std::clamp(static_cast<int>(room.x / (15.0f * em)), 1, count);
  const int rows = (count + grid.columns - 1) / grid.columns;
  grid.columns = (count + rows - 1) / rows;
  grid.cell = {std::floor(room.x / static_cast<float>(grid.columns)),
               std::max(std::floor(room.y / static_cast<float>(rows)), 10.0f * em)};
  return grid;
}

}  // namespace

void draw_plots(Gui& gui) {
  const auto plots = gui.model.plots();
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const PlotGrid grid = lay_out_plots(room, static_cast<int>(plots.size()), gui.em);
  PlotMarks marks;
  marks.shown = degrees(gui.model.frame().tilt);
  if (gui.model.theta_c_known()) marks.theta_c = degrees(gui.model.theta_c());
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0.0f, 0.0f});
  for (std::size_t k = 0; k < plots.size(); ++k) {
    if (k % static_cast<std::size_t>(grid.columns) != 0) ImGui::SameLine();
    draw_plot(gui, plots[k], grid.cell, plots[k].over_tilt ? marks : PlotMarks{});
  }
  ImGui::PopStyleVar();
}

}  // namespace talus
