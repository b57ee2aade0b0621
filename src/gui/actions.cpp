#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "base/errors.h"
#include "base/text.h"
#include "core/trigonometry.h"
#include "gui/panels.h"

namespace talus::gui {
namespace {

/// Reports that a replay does not support an action, and how to start a run that does.
void refuse_in_replay(Gui& gui, const char* what) {
  show_message(
      gui, fmt::format("{}: this is a replay; N continues from the frame shown, as a separate run.", what));
}

/// Returns the reason why a run that has ended does nothing.
std::string ended_text(const view::ViewModel& model, const view::LiveStatus& status) {
  return fmt::format("The run has ended, at {}°; r restarts {}{}.", degrees_text(status.tilt, 2),
                     model.origin() ? "the branch" : "it",
                     status.commands_given > 0 ? ", U undoes the last command" : "");
}

/// Moves by `count` frames, also backwards; reports if there are none.
void advance_frames(Gui& gui, int count) {
  const auto from = static_cast<long>(gui.model.frame_index());
  const long to = std::clamp(from + count, 0L, std::max(static_cast<long>(gui.model.frame_count()) - 1, 0L));
  if (to == from) gui.state.message = count < 0 ? "This is the first frame." : "This is the last frame.";
  gui.model.go_to(static_cast<std::size_t>(to));
}

/// Returns the next multiple of 5 deg in the direction of the tilt, deg, as a target to run to.
double next_round_tilt(const view::LiveStatus& status) {
  const double side = status.tilt_rate < 0.0 ? -1.0 : 1.0;
  return side * 5.0 * (std::floor(side * degrees(status.tilt) / 5.0 + 1e-6) + 1.0) + 0.0;
}

constexpr const char* no_frame_yet = "No frame is recorded yet: the time line begins with the tilt.";

/// Returns the reason why a run has no such place.
std::string absence_of(const view::ViewModel& model, view::Landmark landmark, bool is_running) {
  if (model.frame_count() == 0) return no_frame_yet;
  const std::string name = view::text_of(landmark).sentence;
  if (landmark == view::Landmark::theta_c)
    return is_running ? name + " is not known yet: the slope has not failed."
                      : "There is no failure: the slope remained stable.";
  return name + (is_running ? " is not known yet." : " does not exist, or has not been found yet.");
}

/// Performs an action, whose error becomes the message.
template <typename Action>
void attempt(Gui& gui, const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    show_message(gui, error.what());
  }
}

}  // namespace

void toggle_playing(Gui& gui) {
  if (view::LiveRun* live = gui.model.live()) {
    const view::LiveStatus status = live->status();
    if (status.done) return show_message(gui, ended_text(gui.model, status));
    return status.running ? live->pause() : live->play();
  }
  if (gui.model.frame_count() == 1) gui.state.message = "The run has only one frame.";
  gui.model.play(!gui.model.replay()->playing());
}

void advance(Gui& gui, int count) {
  view::LiveRun* live = gui.model.live();
  if (!live) {
    gui.model.play(false);
    return advance_frames(gui, count);
  }
  if (count > 0 && !gui.model.shows_recorded_frame()) {
    const view::LiveStatus status = live->status();
    return status.done ? show_message(gui, ended_text(gui.model, status)) : live->step(count);
  }
  if (gui.model.frame_count() == 0) return show_message(gui, no_frame_yet);
  if (static_cast<long>(gui.model.frame_index()) + count >= static_cast<long>(gui.model.frame_count()))
    return gui.model.follow();
  advance_frames(gui, count);
}

void deposit(Gui& gui) {
  view::LiveRun* live = gui.model.live();
  if (!live) return refuse_in_replay(gui, "No bed is deposited");
  const view::LiveStatus status = live->status();
  if (status.done) return show_message(gui, ended_text(gui.model, status));
  if (!status.depositing)
    return show_message(
        gui, fmt::format("The bed is deposited and tilted by {}°; space continues, r restarts the run.",
                         degrees_text(status.tilt, 2)));
  live->finish_deposition();
  show_message(gui, "Computing until the bed rests and the tilt begins.");
}

void run_to_tilt(Gui& gui) {
  view::LiveRun* live = gui.model.live();
  if (!live) return refuse_in_replay(gui, "Nothing is computed");
  const view::LiveStatus status = live->status();
  const double tilt = degrees(status.tilt), wanted = gui.state.run_to_tilt;
  if (status.done) return show_message(gui, ended_text(gui.model, status));
  if (std::abs(tilt - wanted) < 1e-6 && !status.depositing) {
    gui.state.run_to_tilt = next_round_tilt(status);
    return show_message(gui, fmt::format("The tilt is already {}°; the target is now {}°.",
                                         fixed_text(tilt, 2), fixed_text(gui.state.run_to_tilt, 2)));
  }
  attempt(gui, [&] {
    live->run_to(radians(wanted));
    show_message(gui, fmt::format("Computing until the tilt is {}°.", fixed_text(wanted, 2)));
  });
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
  attempt(gui, [&] {
    live->apply(command);
    const Command given = live->commands().back();
    show_message(gui, fmt::format("Applied after step {}: {}.", given.step, session::command_text(given)));
  });
}

void reset(Gui& gui) {
  if (!gui.model.is_live()) return refuse_in_replay(gui, "There is nothing to reset");
  if (!gui.model.may_discard()) return;
  attempt(gui, [&] {
    gui.model.restart(static_cast<std::uint64_t>(std::max<std::int64_t>(gui.state.seed, 0)));
    show_message(gui, gui.model.origin() ? "The branch has been restarted."
                                         : fmt::format("A new run, seed {}.", gui.model.recording().seed));
  });
}

void save_state(Gui& gui) {
  if (!gui.model.is_live())
    return show_message(gui, "A replay has nothing to save: its run file holds everything.");
  attempt(gui, [&] {
    const std::string& output = gui.model.recording().output;
    output.empty() ? gui.model.record(gui.state.run_path) : gui.model.live()->save();
    show_message(gui, fmt::format("Saved at step {} in {}.", gui.model.live()->status().step, output));
  });
}

void push_selected(Gui& gui) {
  if (!gui.model.is_live()) return refuse_in_replay(gui, "No grain is pushed");
  if (!gui.state.selected) return show_message(gui, "Click the grain to push first.");
  const double speed =
      gui.state.push_speed * std::sqrt(gui.model.statics().gravity * gui.model.mean_diameter());
  const double angle = radians(gui.state.push_angle);
  send(gui, {0, CommandKind::push, *gui.state.selected, speed * cosine(angle), speed * sine(angle)});
}

void drop_here(Gui& gui) {
  gui.model.follow();
  const Frame& frame = gui.model.frame();
  const bool there = gui.state.selected && *gui.state.selected < frame.grain_count();
  const double x = there ? frame.x[*gui.state.selected] : gui.state.camera.centre_x;
  send(gui, {0, CommandKind::drop, static_cast<Index>(gui.state.drop_count), x,
             gui.state.drop_height * gui.model.mean_diameter()});
}

void branch_here(Gui& gui) {
  if (gui.model.is_live())
    return show_message(gui, "This run is being computed already; U undoes its last command.");
  attempt(gui, [&] {
    gui.model.play(false);
    gui.model.branch();
    const view::LiveStatus status = gui.model.live()->status();
    const double next = next_round_tilt(status);
    gui.state.run_to_tilt = status.tilt_rate < 0.0 ? next : std::max(gui.state.run_to_tilt, next);
    gui.state.message = fmt::format(
        "A branch begins at {}°: push, drop or drag grains (ctrl), change friction or tilt, and play.",
        degrees_text(gui.model.frame().tilt, 2));
  });
}

void go_back(Gui& gui) {
  if (!gui.model.is_live()) return refuse_in_replay(gui, "There is no command to undo");
  attempt(gui, [&] {
    gui.state.drag.reset();
    gui.model.back();
    gui.state.message =
        fmt::format("The command is undone; the run is after step {}.", gui.model.frame().step);
    if (!gui.model.recording().output.empty())
      gui.state.message += " It is recorded in " + gui.model.recording().output + " from here on.";
  });
}

void show_message(Gui& gui, std::string text) { gui.state.message = std::move(text); }

void go_to_landmark(Gui& gui, view::Landmark landmark) {
  const bool live = gui.model.is_live(), is_running = live && !gui.model.live()->status().done;
  if (live && landmark == view::Landmark::last) {
    if (!gui.model.shows_recorded_frame()) show_message(gui, "The current state of the run is shown.");
    return gui.model.follow();
  }
  if (!gui.model.place_of(landmark)) return show_message(gui, absence_of(gui.model, landmark, is_running));
  gui.model.go_to(landmark);
  show_message(gui, fmt::format("{}, at {}°.", view::text_of(landmark).sentence,
                                degrees_text(gui.model.frame().tilt, 2)));
}

void zoom_about(Gui& gui, double factor, double x, double y) {
  if (gui.model.zoom(factor, x, y)) return;
  show_message(gui, factor < 1.0 ? "The whole bed is visible; there is nothing to zoom out to."
                                 : "This is the largest zoom.");
}

void move_picture(Gui& gui, double dx, double dy) {
  const view::ViewCamera& camera = gui.state.camera;
  gui.state.selecting.follow = false;
  if (gui.model.set_camera({camera.centre_x + dx, camera.centre_y + dy, camera.zoom})) return;
  show_message(gui, "The bed ends there; zoom in (+ or the wheel) to move the picture.");
}

void show_whole_bed(Gui& gui) {
  if (gui.state.camera.zoom == 1.0) show_message(gui, "The whole bed is shown.");
  gui.state.selecting.follow = false;
  gui.state.camera.zoom = 1.0;
}

void toggle_following(Gui& gui) {
  gui.state.selecting.follow = !gui.state.selecting.follow;
  if (!gui.state.selecting.follow) return show_message(gui, "The picture follows no grain.");
  if (!gui.state.selected) {
    gui.state.selecting.follow = false;
    return show_message(gui, "Click the grain to follow first.");
  }
  constexpr double surroundings = 40.0;  // D
  gui.state.camera.zoom = std::max(gui.state.camera.zoom,
                                   gui.model.statics().length / (surroundings * gui.model.mean_diameter()));
  show_message(gui, fmt::format("The picture follows grain {}.", *gui.state.selected));
}

}  // namespace talus::gui
