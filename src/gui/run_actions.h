#pragma once
/// What buttons and keys both do.

#include "gui/widgets.h"

namespace talus {

void toggle_playing(Gui& gui);
/// Of a run that is computed: so many steps. Of one that is replayed: so many frames, also back.
void advance(Gui& gui, int count);
/// Sends a command to the run; what it refuses becomes the message.
void send(Gui& gui, const Command& command);
/// Begins the run of a scenario anew, with the seed given.
void reset(Gui& gui);
/// Makes durable what a run that is computed has done: a checkpoint where it is recorded, else all of it, in
/// the file named under files, in which it is recorded from then on.
void save_state(Gui& gui);
void push_selected(Gui& gui);
void drop_here(Gui& gui);
/// Zooms by a factor about a place (m), which stays where it is in the picture.
void zoom_about(Gui& gui, double factor, double x, double y);
void show_whole_bed(Gui& gui);

}  // namespace talus
