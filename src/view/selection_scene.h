#pragma once
/// What is selected, drawn into the picture of the bed so that the map stays readable: thin, without fills.

#include <optional>
#include <vector>

#include "core/bed_frame.h"
#include "core/types.h"
#include "render/frame_view.h"

namespace talus {

struct SelectionMarks {
  std::vector<Index> grains;     ///< each with a thin ring
  std::optional<Index> contact;  ///< of those of the frame: a ring about its point, a line between its bodies
  /// Places of grains from frame to frame, m; in a periodic bed they go on beyond its edge.
  std::vector<std::vector<Vec2>> trails;
};

void add_selection(FrameView& view, const BedFrame& bed, const SelectionMarks& marks);

}  // namespace talus
