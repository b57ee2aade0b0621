#include <cmath>

#include "gui/actions.h"
#include "gui/panels.h"

namespace talus::gui {

void draw_action_panel(Gui& gui) {
  view::LiveRun* live = gui.model.live();
  if (!live) {
    ImGui::TextWrapped(
        "This is a replay. A branch continues from the frame shown: push grains, drop or drag them, change "
        "friction and tilt rate.");
    draw_branch_button(gui);
    return;
  }
  view::ViewState& state = gui.model.state;
  named_number(gui, "push speed", "speed", state.push_speed, "%.3g √(gD)", "speed added to the grain");
  named_number(gui, "push angle", "direction", state.push_angle, "%.0f°",
               "direction of the push: 0 downslope along the bed, 90 away from the floor");
  if (named_button(gui, "push", "Push the grain", "pushes the selected grain")) push_selected(gui);
  ImGui::Separator();
  named_number(gui, "drop count", "grains", state.drop_count,
               "lifted from the surface, far from the selected place");
  named_number(gui, "drop height", "height", state.drop_height, "%.1f D", "above the free surface");
  if (named_button(gui, "drop", "Drop them", "at the selected grain, or in the middle of the picture"))
    drop_here(gui);
  ImGui::Separator();
  const view::LiveStatus status = live->status();
  if (const auto friction = named_slider_when_done(gui, "friction", "friction μ", status.friction, 0.0, 1.5,
                                                   "%.2f", "between grains, and with the floor"))
    send(gui, {0, CommandKind::friction, -1, *friction, 0.0});
  if (const auto rate = named_slider_when_done(gui, "tilt rate", "tilt rate", status.tilt_rate, -10.0, 10.0,
                                               "%.2f°/s", "below 0: downwards; 0 holds the tilt"))
    send(gui, {0, CommandKind::tilt_rate, -1, std::abs(*rate) < 0.1 ? 0.0 : *rate, 0.0});
  ImGui::Separator();
  ImGui::TextWrapped("To drag a grain on the map, hold ctrl.");
  ImGui::BeginDisabled(status.commands_given == 0);
  if (named_button(gui, "back", "back before it",
                   "returns the run to its state before the last command, bit for bit: U"))
    go_back(gui);
  ImGui::EndDisabled();
  ImGui::TextWrapped("Commands, each with the step after which it was applied; talus replay repeats them:");
  for (const Command& command : session::given_commands(live->commands()))
    ImGui::TextWrapped("%lld: %s", static_cast<long long>(command.step),
                       session::command_text(command).c_str());
}

}  // namespace talus::gui
