#pragma once
/// Actions that keys, buttons and the mouse carry out. None is silent: each is seen in the picture, or the
/// line at the bottom says what it did, or why it could not.

#include "gui/widgets.h"

namespace talus::gui {

/// Writes the line at the bottom.
void say(Gui& gui, std::string text);
/// Says that a replay does no such thing, and how a run that does begins with it.
void refuse_in_replay(Gui& gui, const char* what);

// What is shown.

/// Goes to a place of the run.
void go_to_landmark(Gui& gui, view::Landmark landmark);
/// Zooms by a factor about a place (m), which keeps its position in the picture.
void zoom_about(Gui& gui, double factor, double x, double y);
/// Moves the picture, m, which then follows no grain.
void move_picture(Gui& gui, double dx, double dy);
void show_whole_bed(Gui& gui);
/// Keeps the selected grain in the middle of the picture, which shows no more than its surroundings, or ends
/// that.
void toggle_following(Gui& gui);
/// Shows the run that the panel names in the second view.
void show_run_beside(Gui& gui);

// The run.

void toggle_playing(Gui& gui);
/// Advances a run that is computed by that many steps, a replay by that many frames, also backwards: through
/// the frames recorded so far of a run that is computed, after the last of which it is followed again.
void advance(Gui& gui, int count);
/// Computes until the bed rests and the tilt begins.
void deposit(Gui& gui);
/// Computes until the tilt that is offered.
void run_to_tilt(Gui& gui);
/// Offers a tilt to run to that is still to come, once the run has passed the one that was offered.
void offer_tilt_ahead(view::ViewModel& model);
/// Sends a command to the run; the reason of a refusal becomes the message.
void send(Gui& gui, const Command& command);
/// Begins the run of a scenario anew, with the seed given.
void reset(Gui& gui);
/// Saves a run that is computed: by a checkpoint if it is recorded, otherwise by writing all of it to the
/// file named under files, in which it is recorded from then on.
void save_state(Gui& gui);
void push_selected(Gui& gui);
void drop_here(Gui& gui);
/// The replay goes on from the frame shown.
void branch_here(Gui& gui);
/// The run goes back before its last command.
void go_back(Gui& gui);

}  // namespace talus::gui
