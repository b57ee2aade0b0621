#include <algorithm>

#include "core/trigonometry.h"
#include "gui/panels.h"
#include "gui/plot_widget.h"

namespace talus {

void draw_plots(Gui& gui) {
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const float width = std::max(17.0f * gui.em, room.x / 4.0f - 0.5f * gui.em);
  const ImVec2 size{width, std::max(6.0f * gui.em, room.y)};
  const double tilt = degrees(gui.model.frame().tilt);
  bool first = true;
  for (const Plot& plot : gui.model.plots()) {
    if (!first) ImGui::SameLine();
    first = false;
    draw_plot(gui, plot, size, plot.over_tilt ? std::optional(tilt) : std::nullopt);
  }
}

}  // namespace talus
