#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "base/text.h"
#include "core/trigonometry.h"
#include "gui/actions.h"

namespace talus::gui {
namespace {

/// Returns the name as the beginning of a sentence: "The first frame".
const char* name_of(view::Landmark landmark) {
  switch (landmark) {
    case view::Landmark::first:
      return "The first frame";
    case view::Landmark::last:
      return "The last frame";
    case view::Landmark::theta_d:
      return "The frame at which the volume begins to grow";
    case view::Landmark::length_jump:
      return "The frame at which the largest coarse-graining length jumps";
    case view::Landmark::percolation:
      return "The frame in which a cluster first spans from floor to surface";
    case view::Landmark::theta_c:
      return "The last frame before failure";
  }
  return "";
}

/// Returns the reason why a run has no such place.
std::string absence_of(const view::ViewModel& model, view::Landmark landmark, bool is_running) {
  if (model.frame_count() == 0) return "No frame is recorded yet: the time line begins with the tilt.";
  const std::string name = name_of(landmark);
  if (landmark == view::Landmark::theta_c)
    return is_running ? name + " is not known yet: the slope has not failed."
                      : "There is no failure: the slope remained stable.";
  return name + (is_running ? " is not known yet." : " does not exist, or has not been found yet.");
}

}  // namespace

void show_message(Gui& gui, std::string text) { gui.model.state.message = std::move(text); }

void refuse_in_replay(Gui& gui, const char* what) {
  show_message(
      gui, fmt::format("{}: this is a replay; N continues from the frame shown, as a separate run.", what));
}

void go_to_landmark(Gui& gui, view::Landmark landmark) {
  view::ViewModel& model = gui.model;
  const bool live = model.is_live(), is_running = live && !model.live()->status().done;
  if (live && landmark == view::Landmark::last) {
    if (!model.shows_recorded_frame()) show_message(gui, "The current state of the run is shown.");
    return model.follow();
  }
  if (!model.has(landmark)) return show_message(gui, absence_of(model, landmark, is_running));
  model.go_to(landmark);
  show_message(gui, fmt::format("{}, at {}°.", name_of(landmark), degrees_text(model.frame().tilt, 2)));
}

void zoom_about(Gui& gui, double factor, double x, double y) {
  if (gui.model.zoom(factor, x, y)) return;
  show_message(gui, factor < 1.0 ? "The whole bed is visible; there is nothing to zoom out to."
                                 : "This is the largest zoom.");
}

void move_picture(Gui& gui, double dx, double dy) {
  view::ViewModel& model = gui.model;
  const view::ViewCamera& camera = model.state.camera;
  model.state.selecting.follow = false;
  if (model.set_camera({camera.centre_x + dx, camera.centre_y + dy, camera.zoom})) return;
  show_message(gui, "The bed ends there; zoom in (+ or the wheel) to move the picture.");
}

void show_whole_bed(Gui& gui) {
  view::ViewState& state = gui.model.state;
  if (state.camera.zoom == 1.0) show_message(gui, "The whole bed is shown.");
  state.selecting.follow = false;
  state.camera.zoom = 1.0;
}

void toggle_following(Gui& gui) {
  view::ViewState& state = gui.model.state;
  state.selecting.follow = !state.selecting.follow;
  if (!state.selecting.follow) return show_message(gui, "The picture follows no grain.");
  if (!state.selected) {
    state.selecting.follow = false;
    return show_message(gui, "Click the grain to follow first.");
  }
  constexpr double surroundings = 40.0;  // D
  state.camera.zoom =
      std::max(state.camera.zoom, gui.model.statics().length / (surroundings * gui.model.mean_diameter()));
  show_message(gui, fmt::format("The picture follows grain {}.", *state.selected));
}

}  // namespace talus::gui
