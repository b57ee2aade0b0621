#include <cfloat>
#include <cmath>
#include <fmt/core.h>

#include "base/errors.h"
#include "base/text.h"
#include "core/trigonometry.h"
#include "gui/panels.h"

namespace talus::gui {
namespace {

/// Shows how well the solver did; a warning if more steps than usual have missed their tolerance.
void draw_solver(Gui& gui) {
  const auto [count, unconverged, last] = gui.model.solved_steps();
  const bool usual =
      static_cast<double>(unconverged) <= session::usual_unconverged_share * static_cast<double>(count);
  fact("residual", last ? fmt::format("{:.2g}", at(*last, StepField::residual)) : "–");
  fact("iterations", last ? fmt::format("{:.0f}", at(*last, StepField::iterations)) : "–");
  ImGui::PushStyleColor(ImGuiCol_Text, packed(usual ? gui.colours.ink : gui.colours.warning));
  fact("not converged", fmt::format("{} of {} steps", unconverged, count));
  ImGui::PopStyleColor();
  note_place(gui, "not converged", ImGui::GetItemRectMin(),
             {ImGui::GetWindowWidth(), ImGui::GetItemRectMax().y});
}

/// Shows the state of a live run in lines that keep their places while it runs.
void draw_status(Gui& gui, const view::LiveStatus& status) {
  fact("phase", status.done ? "ended" : status.depositing ? "deposition" : "tilt");
  fact("θ", degrees_text(status.tilt, 3) + "°");
  fact("step", std::to_string(status.step));
  fact("time", fmt::format("{:.3f} s", status.time));
  fact("speed",
       status.running ? fmt::format("{:.0f} steps/s", status.steps_per_second) : std::string("paused"));
  fact("θ_c", status.theta_c ? fmt::format("{:.2f}°", degrees(*status.theta_c)) : "not yet known");
  fact("state", status.state_hash.empty() ? "–" : status.state_hash);
  draw_solver(gui);
  if (status.error.empty()) return;
  ImGui::PushStyleColor(ImGuiCol_Text, packed(gui.colours.warning));
  ImGui::TextWrapped("%s", status.error.c_str());
  ImGui::PopStyleColor();
}

/// Shows, for a branch, its parent run and a button that returns to it.
void draw_branch_origin(Gui& gui) {
  const auto& origin = gui.model.origin();
  if (!origin) return;
  ImGui::TextWrapped("branch at frame %lld, %s°", static_cast<long long>(origin->frame),
                     degrees_text(origin->start.world.tilt, 2).c_str());
  if (named_button(gui, "return to the run", "return to the run",
                   "opens the run from which this branch began")) {
    gui.requests.open_path = origin->run;
    gui.requests.open_frame = static_cast<std::size_t>(origin->frame);
  }
  ImGui::Separator();
}

void draw_live(Gui& gui, view::LiveRun& live) {
  const view::LiveStatus status = live.status();
  draw_branch_origin(gui);
  if (icon_button(gui, "play", status.running ? pause_icon : play_icon, "play, pause: space"))
    toggle_playing(gui);
  for (const auto& [name, label, count] :
       {std::tuple{"step 1", "+1", 1}, {"step 10", "+10", 10}, {"step 100", "+100", 100}}) {
    ImGui::SameLine();
    if (named_button(gui, name, label, "steps: right arrow; with shift 10, with ctrl 100"))
      advance(gui, count);
  }
  if (named_button(gui, "run to", "Run to",
                   "compute until the tilt is reached, from below or from above, then pause: g"))
    run_to_tilt(gui);
  ImGui::SameLine();
  ImGui::SetNextItemWidth(5.0f * gui.em);
  named_number(gui, "run to angle", "", gui.state.run_to_tilt, "%.2f°", "the tilt to run to");
  if (status.depositing) {  // last in its row, so that nothing moves when it disappears
    ImGui::SameLine();
    if (named_button(gui, "deposit", "Deposit",
                     "compute until the bed has come to rest and the tilt begins: b"))
      deposit(gui);
  }
  std::vector<std::string> paces;
  for (const view::LivePace& pace : view::live_paces) paces.emplace_back(pace.name);
  named_choice(gui, "pace", "pace", paces, gui.state.pace);
  ImGui::Separator();
  draw_status(gui, status);
  ImGui::Separator();
  const bool branch = gui.model.origin().has_value();
  if (named_button(gui, "reset", "Reset",
                   branch ? "restart the branch: r" : "restart the run with this seed: r"))
    reset(gui);
  if (!branch) {
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("with seed");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-FLT_MIN);
    named_number(gui, "seed", "", gui.state.seed, "seed of the random deposition");
  }
  ImGui::Separator();
  const std::string& output = gui.model.recording().output;
  if (output.empty())
    ImGui::TextDisabled("not recorded; save it under files");
  else
    ImGui::TextWrapped("recorded in %s", output.c_str());
}

void draw_replay(Gui& gui) {
  if (icon_button(gui, "first", "▮◀", "the first frame: home")) go_to_landmark(gui, view::Landmark::first);
  ImGui::SameLine();
  if (icon_button(gui, "back", "◂", "one frame back: left arrow; with shift 10")) advance(gui, -1);
  ImGui::SameLine();
  if (icon_button(gui, "play", gui.model.replay()->playing() ? pause_icon : play_icon, "play, pause: space"))
    toggle_playing(gui);
  ImGui::SameLine();
  if (icon_button(gui, "forward", "▸", "one frame forward: right arrow; with shift 10")) advance(gui, 1);
  ImGui::SameLine();
  if (icon_button(gui, "last", "▶▮", "the last frame: end")) go_to_landmark(gui, view::Landmark::last);
  int frame = static_cast<int>(gui.model.frame_index());
  ImGui::SetNextItemWidth(-1.0f);
  if (ImGui::SliderInt("##frame", &frame, 0, static_cast<int>(gui.model.frame_count()) - 1,
                       frame_counter(gui.model.frame_index(), gui.model.frame_count()).c_str(),
                       ImGuiSliderFlags_AlwaysClamp))
    gui.model.go_to(static_cast<std::size_t>(frame));
  note_place(gui, "frame");
  fact("time", fmt::format("{:.3f} s", gui.model.frame().time));
  draw_solver(gui);
  double speed = gui.model.replay()->speed();
  if (named_slider(gui, "speed", "speed", speed, 0.1, 20.0, "%.1f°/s", "speed of the replay: < and >", true))
    gui.model.replay()->set_speed(speed);
}

}  // namespace

std::string frame_counter(std::size_t frame, std::size_t count) {
  return fmt::format("frame {} (0 to {})", frame, count - 1);
}

void draw_run_panel(Gui& gui) {
  ImGui::TextWrapped("%s", gui.model.path().c_str());
  ImGui::Separator();
  if (view::LiveRun* live = gui.model.live())
    draw_live(gui, *live);
  else
    draw_replay(gui);
}

void draw_action_panel(Gui& gui) {
  view::LiveRun* live = gui.model.live();
  if (!live) {
    ImGui::TextWrapped(
        "This is a replay. A branch continues from the frame shown: push grains, drop or drag them, change "
        "friction and tilt rate.");
    if (named_button(gui, "branch here", "branch here",
                     "continue from this frame as a separate run: N; this run stays unchanged"))
      branch_here(gui);
    return;
  }
  named_number(gui, "push speed", "speed", gui.state.push_speed, "%.3g √(gD)", "speed added to the grain");
  named_number(gui, "push angle", "direction", gui.state.push_angle, "%.0f°",
               "direction of the push: 0 downslope along the bed, 90 away from the floor");
  if (named_button(gui, "push", "Push the grain", "pushes the selected grain")) push_selected(gui);
  ImGui::Separator();
  named_number(gui, "drop count", "grains", gui.state.drop_count,
               "lifted from the surface, far from the selected place");
  named_number(gui, "drop height", "height", gui.state.drop_height, "%.1f D", "above the free surface");
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
