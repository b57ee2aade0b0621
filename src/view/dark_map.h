#pragma once
/// Maps on a dark background.

#include "render/frame_view.h"

namespace talus::view {

/// Returns the map for a dark background. The space behind the discs is left empty, and all grays of the bed
/// and of the legends are mirrored; colours stay. If the middle of a colour bar is gray, the grains keep
/// their colours, and only lines and the floor are mirrored.
render::FrameView on_dark_ground(render::FrameView map);

}  // namespace talus::view
