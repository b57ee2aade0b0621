#pragma once
/// Actions that both buttons and keys carry out.

#include "gui/widgets.h"

namespace talus {

void toggle_playing(Gui& gui);
/// Advances a run that is computed by that many steps, a replay by that many frames, also backwards: through
/// the frames recorded so far of a run that is computed, after the last of which it is followed again.
void advance(Gui& gui, int count);
/// Sends a command to the run; the reason of a refusal becomes the message.
void send(Gui& gui, const Command& command);
/// Begins the run of a scenario anew, with the seed given.
void reset(Gui& gui);
/// Saves a run that is computed: by a checkpoint if it is recorded, otherwise by writing all of it to the
/// file named under files, in which it is recorded from then on.
void save_state(Gui& gui);
void push_selected(Gui& gui);
void drop_here(Gui& gui);
/// Zooms by a factor about a place (m), which keeps its position in the picture.
void zoom_about(Gui& gui, double factor, double x, double y);
void show_whole_bed(Gui& gui);
/// Keeps the selected grain in the middle of the picture, which shows no more than its surroundings, or ends
/// that.
void toggle_following(Gui& gui);

}  // namespace talus
