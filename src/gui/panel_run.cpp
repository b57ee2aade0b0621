#include <cfloat>
#include <cmath>
#include <fmt/core.h>

#include "base/errors.h"
#include "base/text.h"
#include "core/trigonometry.h"
#include "gui/actions.h"
#include "gui/panels.h"
#include "gui/widgets.h"

namespace talus::gui {
namespace {

/// Shows the state of a live run in lines that keep their places while it runs.
void draw_status(const Palette& colours, const view::LiveStatus& status, bool theta_c_known, double theta_c) {
  fact("phase", status.done ? "ended" : status.depositing ? "deposition" : "tilt");
  fact("θ", degrees_text(status.tilt, 3) + "°");
  fact("step", std::to_string(status.step));
  fact("time", fmt::format("{:.3f} s", status.time));
  fact("speed",
       status.running ? fmt::format("{:.0f} steps/s", status.steps_per_second) : std::string("paused"));
  fact("θ_c", theta_c_known ? fmt::format("{:.2f}°", degrees(theta_c)) : "not yet known");
  fact("state", status.state_hash.empty() ? "–" : status.state_hash);
  if (status.error.empty()) return;
  ImGui::PushStyleColor(ImGuiCol_Text, packed(colours.warning));
  ImGui::TextWrapped("%s", status.error.c_str());
  ImGui::PopStyleColor();
}

/// Shows, for a branch, its parent run and a button that returns to it.
void draw_branch_origin(Gui& gui) {
  const auto line = gui.model.branch_line();
  if (!line) return;
  ImGui::TextWrapped("branch at frame %zu, %s°", line->frame,
                     degrees_text(line->tilts[line->frame], 2).c_str());
  if (named_button(gui, "return to the run", "return to the run",
                   "opens the run from which this branch began")) {
    gui.requests.open_path = line->run;
    gui.requests.open_frame = line->frame;
  }
  ImGui::Separator();
}

void draw_live(Gui& gui, view::LiveRun& live) {
  const view::LiveStatus status = live.status();
  view::ViewState& state = gui.model.state;
  draw_branch_origin(gui);
  if (icon_button(gui, "play", status.running ? Icon::pause : Icon::play, "play, pause: space"))
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
  named_number(gui, "run to angle", "", state.run_to_tilt, "%.2f°", "the tilt to run to");
  if (status.depositing) {  // last in its row, so that nothing moves when it disappears
    ImGui::SameLine();
    if (named_button(gui, "deposit", "Deposit",
                     "compute until the bed has come to rest and the tilt begins: b"))
      deposit(gui);
  }
  std::vector<std::string> paces;
  for (const view::LivePace& pace : view::live_paces) paces.emplace_back(pace.name);
  named_choice(gui, "pace", "pace", paces, state.pace);
  ImGui::Separator();
  draw_status(gui.colours, status, gui.model.theta_c_known(), gui.model.theta_c());
  ImGui::TextWrapped("%s", applied_text(live.commands()).c_str());
  ImGui::Separator();
  if (gui.model.branch_line()) {
    if (named_button(gui, "reset", "Reset", "restart the branch: r")) reset(gui);
  } else {
    if (named_button(gui, "reset", "Reset", "restart the run with this seed: r")) reset(gui);
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("with seed");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-FLT_MIN);
    named_number(gui, "seed", "", state.seed, "seed of the random deposition");
  }
  ImGui::Separator();
  const std::string output = gui.model.recording().output;
  if (output.empty())
    ImGui::TextDisabled("not recorded; save it under files");
  else
    ImGui::TextWrapped("recorded in %s", output.c_str());
}

void draw_landmarks(Gui& gui) {
  view::ViewModel& model = gui.model;
  struct LandmarkButton {
    const char* name;
    const char* label;
    view::Landmark landmark;
    const char* tip;
  };
  const LandmarkButton places[] = {
      {"theta_d", "θ_d", view::Landmark::theta_d, "transition from contraction to dilation: d"},
      {"length jump", "ℓ_c jumps", view::Landmark::length_jump,
       "jump of the largest coarse-graining length: j"},
      {"percolation", "spans", view::Landmark::percolation,
       "first cluster that spans from floor to surface: p"},
      {"theta_c", "θ_c", view::Landmark::theta_c, "the last frame before failure: c"}};
  bool first = true;
  for (const LandmarkButton& place : places) {
    if (!first) same_line_if_fits(rich_width(*ImGui::GetFont(), ImGui::GetFontSize(), place.label) + gui.em);
    first = false;
    ImGui::BeginDisabled(!model.has(place.landmark));
    if (named_button(gui, place.name, place.label, place.tip)) go_to_landmark(gui, place.landmark);
    ImGui::EndDisabled();
  }
}

void draw_replay(Gui& gui) {
  view::ViewModel& model = gui.model;
  if (icon_button(gui, "first", Icon::first, "the first frame: home"))
    go_to_landmark(gui, view::Landmark::first);
  ImGui::SameLine();
  if (icon_button(gui, "back", Icon::back, "one frame back: left arrow; with shift 10")) advance(gui, -1);
  ImGui::SameLine();
  if (icon_button(gui, "play", model.playing() ? Icon::pause : Icon::play, "play, pause: space"))
    toggle_playing(gui);
  ImGui::SameLine();
  if (icon_button(gui, "forward", Icon::forward, "one frame forward: right arrow; with shift 10"))
    advance(gui, 1);
  ImGui::SameLine();
  if (icon_button(gui, "last", Icon::last, "the last frame: end")) go_to_landmark(gui, view::Landmark::last);
  int frame = static_cast<int>(model.frame_index());
  ImGui::SetNextItemWidth(-1.0f);
  if (ImGui::SliderInt("##frame", &frame, 0, static_cast<int>(model.frame_count()) - 1,
                       frame_counter(model.frame_index(), model.frame_count()).c_str(),
                       ImGuiSliderFlags_AlwaysClamp))
    model.go_to(static_cast<std::size_t>(frame));
  note_place(gui, "frame");
  draw_landmarks(gui);
  draw_branch_button(gui);
  double speed = model.speed();
  if (named_slider(gui, "speed", "speed", speed, 0.1, 20.0, "%.1f°/s", "speed of the replay: < and >", true))
    model.set_speed(speed);
  ImGui::Separator();
  fact("θ", degrees_text(model.frame().tilt, 3) + "°");
  const bool failed = model.theta_c_known();
  fact("θ_c", failed ? fmt::format("{:.2f}°", degrees(model.theta_c())) : "–");
  fact("θ_c − θ",
       failed ? fmt::format("{:.2f}°", degrees(model.theta_c() - std::abs(model.frame().tilt))) : "–");
  fact("step", std::to_string(model.frame().step));
  fact("time", fmt::format("{:.3f} s", model.frame().time));
  fact("contacts", std::to_string(model.frame().contacts.count()));
}

}  // namespace

void draw_branch_button(Gui& gui) {
  if (named_button(gui, "branch here", "branch here",
                   "continue from this frame as a separate run: N; this run stays unchanged"))
    branch_here(gui);
}

std::string applied_text(std::span<const Command> commands) {
  const std::vector<Command> given = session::given_commands(commands);
  if (given.empty()) return "no command applied yet";
  return fmt::format("applied last, after step {}: {}", given.back().step,
                     session::command_text(given.back()));
}

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

}  // namespace talus::gui
