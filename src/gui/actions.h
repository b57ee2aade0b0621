#pragma once
/// Actions of keys, buttons and the mouse. Each has a visible effect, or the line at the bottom says what it
/// did or why it could not.

#include "gui/widgets.h"

namespace talus::gui {

/// Writes the line at the bottom.
void show_message(Gui& gui, std::string text);
/// Reports that a replay does not support an action, and how to start a run that does.
void refuse_in_replay(Gui& gui, const char* what);

// Picture.

/// Goes to a landmark of the run.
void go_to_landmark(Gui& gui, view::Landmark landmark);
/// Zooms by a factor about a place (m), which keeps its position in the picture.
void zoom_about(Gui& gui, double factor, double x, double y);
/// Moves the picture (m), and stops following a grain.
void move_picture(Gui& gui, double dx, double dy);
void show_whole_bed(Gui& gui);
/// Starts or stops keeping the selected grain, with its surroundings, in the middle of the picture.
void toggle_following(Gui& gui);

// Run.

void toggle_playing(Gui& gui);
/// Advances a live run by `count` steps, or a replay by `count` frames, which may be negative. In a live run,
/// stepping back goes through the frames recorded so far; stepping forward beyond the last of them follows
/// the run again.
void advance(Gui& gui, int count);
/// Computes until the bed has come to rest and the tilt begins.
void deposit(Gui& gui);
/// Computes until the tilt entered by the user.
void run_to_tilt(Gui& gui);
/// Suggests a later tilt to run to, once the run has passed the suggested one.
void offer_tilt_ahead(view::ViewModel& model);
/// Sends a command to the run; the reason of a rejection becomes the message.
void send(Gui& gui, const Command& command);
/// Restarts the run of a scenario with the given seed.
void reset(Gui& gui);
/// Saves a live run: by a checkpoint if it is recorded; otherwise by writing it from its beginning to the
/// file named in the panel of files, in which it is then recorded.
void save_state(Gui& gui);
void push_selected(Gui& gui);
void drop_here(Gui& gui);
/// Continues the replay from the frame shown.
void branch_here(Gui& gui);
/// Returns the run to the state before its last command.
void go_back(Gui& gui);

}  // namespace talus::gui
