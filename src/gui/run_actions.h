#pragma once
/// Actions on a run that both buttons and keys carry out. None is silent: what cannot be done is told with
/// the reason.

#include "gui/widgets.h"

namespace talus {

void toggle_playing(Gui& gui);
/// Advances a run that is computed by that many steps, a replay by that many frames, also backwards: through
/// the frames recorded so far of a run that is computed, after the last of which it is followed again.
void advance(Gui& gui, int count);
/// Computes until the bed rests and the tilt begins.
void deposit(Gui& gui);
/// Computes until the tilt that is offered.
void run_to_tilt(Gui& gui);
/// The next multiple of 5 deg above a tilt (deg), as one to run to.
double next_round_tilt(double tilt);
/// Offers a tilt to run to that is still to come, once the run has passed the one that was offered.
void offer_tilt_ahead(ViewModel& model);
/// Sends a command to the run; the reason of a refusal becomes the message.
void send(Gui& gui, const Command& command);
/// Begins the run of a scenario anew, with the seed given.
void reset(Gui& gui);
/// Saves a run that is computed: by a checkpoint if it is recorded, otherwise by writing all of it to the
/// file named under files, in which it is recorded from then on.
void save_state(Gui& gui);
void push_selected(Gui& gui);
void drop_here(Gui& gui);

}  // namespace talus
