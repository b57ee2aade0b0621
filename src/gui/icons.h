#pragma once
/// Buttons with a sign that says more than a word: drawn as shapes, so that they are sharp at any size.

#include "gui/widgets.h"

namespace talus {

enum class Icon { play, pause, back, forward, first, last };

/// A button as wide as every other of these, remembered under `name`; true if the user has used it.
bool icon_button(Gui& gui, const char* name, Icon icon, const char* tip);

}  // namespace talus
