#include "gui/branching.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/core.h>

#include "core/drag_spring.h"
#include "core/errors.h"
#include "core/trigonometry.h"
#include "gui/run_actions.h"
#include "gui/view_actions.h"

namespace talus {
namespace {

/// Where a spring can be held that is to be held at the mouse: not farther from the grain than commands
/// allow.
std::array<double, 2> within_reach(const ViewModel& model, Index grain, double x, double y) {
  const Frame& frame = model.frame();
  const double dx = x - frame.x[grain], dy = y - frame.y[grain];
  const double share = 0.9 * farthest_drag * model.mean_diameter() / std::max(1e-300, std::hypot(dx, dy));
  return {frame.x[grain] + std::min(1.0, share) * dx, frame.y[grain] + std::min(1.0, share) * dy};
}

/// What the spring does is told while it does it; what stands in the way ends the drag.
void hold_at(Gui& gui, Index grain, double x, double y) {
  ViewModel& model = gui.model;
  const auto [held_x, held_y] = within_reach(model, grain, x, y);
  try {
    model.live()->apply({0, CommandKind::drag, grain, held_x, held_y});
    const double distance = std::hypot(held_x - model.frame().x[grain], held_y - model.frame().y[grain]);
    model.state.message = fmt::format(
        "Grain {} is pulled with {:.0f} m g.{}", grain, drag_stiffness * distance / model.mean_diameter(),
        model.live()->status().running ? "" : " The run is paused: space goes on.");
    model.state.drag = GrainDrag{grain, x, y, model.live()->status().step};
  } catch (const Error& error) {
    model.state.message = error.what();
    model.state.drag.reset();
  }
}

/// The free grain on which a lasso would begin, once the mouse moves: a click is for a contact.
std::optional<Index> first_grain(const ViewModel& model, const MapPlaces& places) {
  const SelectingState& selecting = model.state.selecting;
  if (selecting.outline.size() != 1 || selecting.outline_is_box || ImGui::GetIO().KeyShift) return {};
  if (!ImGui::IsMouseDragging(0, least_drag)) return {};
  const Vec2 first = selecting.outline.front();
  const Point at = places.bed({static_cast<float>(first.x), static_cast<float>(first.y)});
  const std::optional<Index> grain = model.grain_at(at.x, at.y);
  return grain && *grain < model.statics().free_count ? grain : std::nullopt;
}

/// Whether a grain would be pulled, had the run not ended: then no lasso begins there, which would drop what
/// is selected.
bool refuse_after_end(Gui& gui, const MapPlaces& places) {
  ViewModel& model = gui.model;
  SelectingState& selecting = model.state.selecting;
  const bool waits = ImGui::IsItemActive() && !ImGui::IsItemActivated() && ImGui::GetIO().KeyCtrl &&
                     !ImGui::GetIO().KeyShift && selecting.outline.empty();
  if (waits) return true;  // the mouse goes on after it was refused
  if (model.looks_back() || !model.live()->status().done || !first_grain(model, places)) return false;
  selecting.outline.clear();
  model.state.message =
      "The run has ended: no grain can be pulled. U goes back before a command; with shift ctrl draws a "
      "lasso.";
  return true;
}

/// Those that are selected stay where it is one of them.
void look_at(ViewModel& model, Index grain) {
  if (std::ranges::binary_search(model.selected_grains(), grain))
    model.state.selected = grain;
  else
    model.select(std::optional(grain));
}

void let_go(Gui& gui) {
  ViewModel& model = gui.model;
  model.state.drag.reset();
  if (!model.live() || !model.live()->status().dragged) return;
  send(gui, {0, CommandKind::release, -1, 0.0, 0.0});
}

void draw_spring(Gui& gui, const MapPlaces& places) {
  const GrainDrag& drag = *gui.model.state.drag;
  const Frame& frame = gui.model.frame();
  const ImVec2 from = places.pixel(frame.x[drag.grain], frame.y[drag.grain]),
               to = places.pixel(drag.x, drag.y);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImU32 colour = packed(gui.colours.curves[2]);
  list.AddLine(from, to, colour, 0.15f * gui.em);
  list.AddCircleFilled(to, 0.25f * gui.em, colour);
}

}  // namespace

void branch_here(Gui& gui) {
  ViewModel& model = gui.model;
  if (model.is_live()) {
    model.state.message = "This run is being computed already; U goes back before its last command.";
    return;
  }
  try {
    model.play(false);
    model.branch();
    model.state.run_to_tilt = std::max(model.state.run_to_tilt, next_round_tilt(degrees(model.frame().tilt)));
    model.state.message = fmt::format(
        "A branch begins at {:.2f}°: push, drop or drag grains (ctrl), change friction or tilt, and play.",
        degrees(model.frame().tilt));
  } catch (const Error& error) {
    model.state.message = error.what();
  }
}

void go_back(Gui& gui) {
  ViewModel& model = gui.model;
  if (!model.is_live()) return refuse_in_replay(gui, "There is no command to take back");
  try {
    model.state.drag.reset();
    model.back();
    model.state.message = fmt::format("As it was before the command, after step {}.", model.frame().step);
    if (!model.recording().output.empty())
      model.state.message += " It is recorded in " + model.recording().output + " from here on.";
  } catch (const Error& error) {
    model.state.message = error.what();
  }
}

void draw_branch_button(Gui& gui) {
  if (named_button(gui, "branch here", "branch here",
                   "go on from this frame, as a run of its own: N; the run stays as it is"))
    branch_here(gui);
}

void draw_branch_origin(Gui& gui) {
  const auto line = gui.model.branch_line();
  if (!line) return;
  ImGui::TextWrapped("branch at frame %zu, %.2f°", line->frame, degrees(line->tilts[line->frame]));
  if (named_button(gui, "return to the run", "return to the run",
                   "open the run again that this branch left")) {
    gui.requests.open_path = line->run;
    gui.requests.open_frame = line->frame;
  }
  ImGui::Separator();
}

void draw_back_button(Gui& gui) {
  ImGui::BeginDisabled(gui.model.live()->status().commands_given == 0);
  if (named_button(gui, "back", "back before it", "as the run was before the last command, to the bit: U"))
    go_back(gui);
  ImGui::EndDisabled();
}

bool drag_grain(Gui& gui, double x, double y, const MapPlaces& places) {
  ViewModel& model = gui.model;
  auto& drag = model.state.drag;
  if (!model.is_live()) {
    drag.reset();
    return false;
  }
  if (!drag) {
    if (refuse_after_end(gui, places)) return true;
    const std::optional<Index> grain = model.looks_back() ? std::nullopt : first_grain(model, places);
    if (!grain) return false;
    model.state.selecting.outline.clear();
    model.state.selecting.follow = false;  // else the picture would run after the mouse, and the mouse ahead
    look_at(model, *grain);
    hold_at(gui, *grain, x, y);
    return true;
  }
  if (!ImGui::IsMouseDown(0)) {
    let_go(gui);
    return true;
  }
  // One place a step: those between two steps would do nothing.
  if (model.live()->status().step != drag->step && (x != drag->x || y != drag->y))
    hold_at(gui, drag->grain, x, y);
  if (drag) draw_spring(gui, places);
  return true;
}

}  // namespace talus
