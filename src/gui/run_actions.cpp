#include "gui/run_actions.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "core/errors.h"
#include "core/trigonometry.h"

namespace talus {

void toggle_playing(Gui& gui) {
  ViewModel& model = gui.model;
  if (LiveRun* live = model.live())
    live->status().running ? live->pause() : live->play();
  else
    model.play(!model.playing());
}

void advance(Gui& gui, int count) {
  ViewModel& model = gui.model;
  if (LiveRun* live = model.live()) {
    if (count > 0 && !model.looks_back()) return live->step(count);
    const auto to = static_cast<long>(model.frame_index()) + count;
    if (to >= static_cast<long>(model.frame_count())) return model.follow();
    return model.go_to(static_cast<std::size_t>(std::max(to, 0L)));
  }
  model.play(false);
  const auto last = static_cast<long>(model.frame_count()) - 1;
  model.go_to(static_cast<std::size_t>(
      std::clamp(static_cast<long>(model.frame_index()) + count, 0L, std::max(last, 0L))));
}

void send(Gui& gui, const Command& command) {
  LiveRun* live = gui.model.live();
  if (!live) return;
  gui.model.follow();  // a command is to the run as it is now
  try {
    live->apply(command);
    const Command given = live->commands().back();
    gui.model.state.message = fmt::format("Done after step {}: {}.", given.step, command_text(given));
  } catch (const Error& error) {
    gui.model.state.message = error.what();
  }
}

void reset(Gui& gui) {
  ViewModel& model = gui.model;
  if (!model.is_live() || !model.may_discard()) return;
  try {
    model.restart(static_cast<std::uint64_t>(std::max(model.state.seed, 0)));
    model.state.message =
        model.branch_line() ? "The branch begins anew." : fmt::format("A new run, seed {}.", model.seed());
  } catch (const Error& error) {
    model.state.message = error.what();
  }
}

void save_state(Gui& gui) {
  ViewModel& model = gui.model;
  if (!model.is_live()) {
    model.state.message = "A replay has nothing to save: its run file holds everything.";
    return;
  }
  try {
    if (model.recording().output.empty())
      model.record(model.state.run_path);
    else
      model.live()->save();
    model.state.message =
        fmt::format("Saved at step {} in {}.", model.live()->status().step, model.recording().output);
  } catch (const Error& error) {
    model.state.message = error.what();
  }
}

void push_selected(Gui& gui) {
  const ViewState& state = gui.model.state;
  if (!state.selected) {
    gui.model.state.message = "Click the grain to push first.";
    return;
  }
  const double speed = state.push_speed * std::sqrt(gui.model.statics().gravity * gui.model.mean_diameter());
  const double angle = radians(state.push_angle);
  send(gui, {0, CommandKind::push, *state.selected, speed * cosine(angle), speed * sine(angle)});
}

void drop_here(Gui& gui) {
  gui.model.follow();
  const ViewState& state = gui.model.state;
  const Frame& frame = gui.model.frame();
  const double x = state.selected ? frame.x[*state.selected] : state.camera.centre_x;
  send(gui, {0, CommandKind::drop, static_cast<Index>(state.drop_count), x,
             state.drop_height * gui.model.mean_diameter()});
}

void zoom_about(Gui& gui, double factor, double x, double y) {
  ViewCamera& camera = gui.model.state.camera;
  const double zoom = std::clamp(camera.zoom * factor, 1.0, 400.0);
  const double ratio = camera.zoom / zoom;
  camera.centre_x = x + (camera.centre_x - x) * ratio;
  camera.centre_y = y + (camera.centre_y - y) * ratio;
  camera.zoom = zoom;
}

void show_whole_bed(Gui& gui) {
  gui.model.state.selecting.follow = false;
  gui.model.state.camera.zoom = 1.0;
}

void toggle_following(Gui& gui) {
  ViewState& state = gui.model.state;
  state.selecting.follow = !state.selecting.follow;
  if (!state.selecting.follow) return;
  if (!state.selected) {
    state.selecting.follow = false;
    state.message = "Click the grain to follow first.";
    return;
  }
  constexpr double surroundings = 40.0;  // D
  state.camera.zoom =
      std::max(state.camera.zoom, gui.model.statics().length / (surroundings * gui.model.mean_diameter()));
}

}  // namespace talus
