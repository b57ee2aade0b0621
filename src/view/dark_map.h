#pragma once
/// Maps on a dark ground.

#include "render/frame_view.h"

namespace talus::view {

/// A map as it is shown on a dark ground: nothing behind its discs, and all of its grays mirrored, in the bed
/// and in its legends, so that black shines and white is dark; colours stay. Where the gray of a bar is the
/// middle of its colours, grains keep theirs, and only lines and the floor are mirrored.
render::FrameView on_dark_ground(render::FrameView map);

}  // namespace talus::view
