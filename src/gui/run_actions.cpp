#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "base/errors.h"
#include "base/text.h"
#include "core/trigonometry.h"
#include "gui/actions.h"

namespace talus::gui {

namespace {

/// Returns the reason why a run that has ended does nothing.
std::string ended_text(const view::ViewModel& model, const view::LiveStatus& status) {
  return fmt::format("The run has ended, at {}°; r restarts {}{}.", degrees_text(status.tilt, 2),
                     model.branch_line() ? "the branch" : "it",
                     status.commands_given > 0 ? ", U undoes the last command" : "");
}

/// Moves by `count` frames, also backwards; reports if there are none.
void advance_frames(Gui& gui, int count) {
  view::ViewModel& model = gui.model;
  const auto last = static_cast<long>(model.frame_count()) - 1;
  const auto from = static_cast<long>(model.frame_index());
  const long to = std::clamp(from + count, 0L, std::max(last, 0L));
  if (to == from) model.state.message = count < 0 ? "This is the first frame." : "This is the last frame.";
  model.go_to(static_cast<std::size_t>(to));
}

/// Returns the next multiple of 5 deg in the direction of the tilt, deg, as a target to run to.
double next_round_tilt(const view::LiveStatus& status) {
  const double side = status.tilt_rate < 0.0 ? -1.0 : 1.0;
  return side * 5.0 * (std::floor(side * degrees(status.tilt) / 5.0 + 1e-6) + 1.0) + 0.0;
}

}  // namespace

void toggle_playing(Gui& gui) {
  view::ViewModel& model = gui.model;
  if (view::LiveRun* live = model.live()) {
    const view::LiveStatus status = live->status();
    if (status.done)
      model.state.message = ended_text(model, status);
    else
      status.running ? live->pause() : live->play();
    return;
  }
  if (model.frame_count() == 1) model.state.message = "The run has only one frame.";
  model.play(!model.playing());
}

void advance(Gui& gui, int count) {
  view::ViewModel& model = gui.model;
  view::LiveRun* live = model.live();
  if (!live) {
    model.play(false);
    return advance_frames(gui, count);
  }
  if (count > 0 && !model.shows_recorded_frame()) {
    if (live->status().done)
      model.state.message = ended_text(model, live->status());
    else
      live->step(count);
    return;
  }
  if (model.frame_count() == 0) {
    model.state.message = "No frame is recorded yet: the time line begins with the tilt.";
    return;
  }
  if (static_cast<long>(model.frame_index()) + count >= static_cast<long>(model.frame_count()))
    return model.follow();
  advance_frames(gui, count);
}

void deposit(Gui& gui) {
  view::ViewModel& model = gui.model;
  view::LiveRun* live = model.live();
  if (!live) return refuse_in_replay(gui, "No bed is deposited");
  const view::LiveStatus status = live->status();
  if (status.depositing) {
    live->finish_deposition();
    model.state.message = "Computing until the bed rests and the tilt begins.";
  } else {
    model.state.message = status.done ? ended_text(model, status)
                                      : fmt::format(
                                            "The bed is deposited and tilted by {}°; space "
                                            "continues, r restarts the run.",
                                            degrees_text(status.tilt, 2));
  }
}

void run_to_tilt(Gui& gui) {
  view::ViewModel& model = gui.model;
  view::LiveRun* live = model.live();
  if (!live) return refuse_in_replay(gui, "Nothing is computed");
  const view::LiveStatus status = live->status();
  const double tilt = degrees(status.tilt), wanted = model.state.run_to_tilt;
  if (status.done) {
    model.state.message = ended_text(model, status);
  } else if (std::abs(tilt - wanted) < 1e-6 && !status.depositing) {
    model.state.run_to_tilt = next_round_tilt(status);
    model.state.message = fmt::format("The tilt is already {}°; the target is now {}°.", fixed_text(tilt, 2),
                                      fixed_text(model.state.run_to_tilt, 2));
  } else {
    try {
      live->run_to(radians(wanted));
      model.state.message = fmt::format("Computing until the tilt is {}°.", fixed_text(wanted, 2));
    } catch (const Error& error) {
      model.state.message = error.what();
    }
  }
}

void offer_tilt_ahead(view::ViewModel& model) {
  if (!model.is_live() || ImGui::IsAnyItemActive()) return;
  const view::LiveStatus status = model.live()->status();
  const double ahead =
      (model.state.run_to_tilt - degrees(status.tilt)) * (status.tilt_rate < 0.0 ? -1.0 : 1.0);
  const bool passed = status.running ? ahead < 1e-6 : std::abs(ahead) < 1e-6;
  if (passed) model.state.run_to_tilt = next_round_tilt(status);
}

void send(Gui& gui, const Command& command) {
  view::LiveRun* live = gui.model.live();
  if (!live) return refuse_in_replay(gui, "Commands are not possible");
  gui.model.follow();  // a command applies to the current state of the run
  try {
    live->apply(command);
    const Command given = live->commands().back();
    gui.model.state.message =
        fmt::format("Applied after step {}: {}.", given.step, session::command_text(given));
  } catch (const Error& error) {
    gui.model.state.message = error.what();
  }
}

void reset(Gui& gui) {
  view::ViewModel& model = gui.model;
  if (!model.is_live()) return refuse_in_replay(gui, "There is nothing to reset");
  if (!model.may_discard()) return;
  try {
    model.restart(static_cast<std::uint64_t>(std::max<std::int64_t>(model.state.seed, 0)));
    model.state.message = model.branch_line() ? "The branch has been restarted."
                                              : fmt::format("A new run, seed {}.", model.seed());
  } catch (const Error& error) {
    model.state.message = error.what();
  }
}

void save_state(Gui& gui) {
  view::ViewModel& model = gui.model;
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
  const view::ViewState& state = gui.model.state;
  if (!gui.model.is_live()) return refuse_in_replay(gui, "No grain is pushed");
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
  const view::ViewState& state = gui.model.state;
  const Frame& frame = gui.model.frame();
  const double x = state.selected ? frame.x[*state.selected] : state.camera.centre_x;
  send(gui, {0, CommandKind::drop, static_cast<Index>(state.drop_count), x,
             state.drop_height * gui.model.mean_diameter()});
}

void branch_here(Gui& gui) {
  view::ViewModel& model = gui.model;
  if (model.is_live()) {
    model.state.message = "This run is being computed already; U undoes its last command.";
    return;
  }
  try {
    model.play(false);
    model.branch();
    const view::LiveStatus status = model.live()->status();
    const double next = next_round_tilt(status);
    model.state.run_to_tilt = status.tilt_rate < 0.0 ? next : std::max(model.state.run_to_tilt, next);
    model.state.message = fmt::format(
        "A branch begins at {}°: push, drop or drag grains (ctrl), change friction or tilt, and play.",
        degrees_text(model.frame().tilt, 2));
  } catch (const Error& error) {
    model.state.message = error.what();
  }
}

void go_back(Gui& gui) {
  view::ViewModel& model = gui.model;
  if (!model.is_live()) return refuse_in_replay(gui, "There is no command to undo");
  try {
    model.state.drag.reset();
    model.back();
    model.state.message = fmt::format("The command is undone; the run is after step {}.", model.frame().step);
    if (!model.recording().output.empty())
      model.state.message += " It is recorded in " + model.recording().output + " from here on.";
  } catch (const Error& error) {
    model.state.message = error.what();
  }
}

}  // namespace talus::gui
