#pragma once
/// Actions on what is shown, by keys, buttons and the mouse. None is silent: each is seen in the picture, or
/// the line at the bottom says what it did, or why it could not.

#include "gui/widgets.h"

namespace talus {

/// Goes to a place of the run.
void go_to_landmark(Gui& gui, Landmark landmark);
/// Says that a replay does no such thing, and how a run that does begins with it.
void refuse_in_replay(Gui& gui, const char* what);
/// Zooms by a factor about a place (m), which keeps its position in the picture.
void zoom_about(Gui& gui, double factor, double x, double y);
/// Moves the picture, m, which then follows no grain.
void move_picture(Gui& gui, double dx, double dy);
void show_whole_bed(Gui& gui);
/// Keeps the selected grain in the middle of the picture, which shows no more than its surroundings, or ends
/// that.
void toggle_following(Gui& gui);
void toggle_trails(Gui& gui);
/// The speed of a replay times a factor.
void change_speed(Gui& gui, double factor);
/// What a key changes of how the bed is drawn; false for a key that is for nothing of that.
bool change_view(Gui& gui, ImWchar key);

}  // namespace talus
