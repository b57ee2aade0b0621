#pragma once
/// The bed as a picture: what is seen of it, with copies across a periodic edge.

#include "pictures/maps.h"
#include "render/frame_view.h"

namespace talus {

/// What is shown, without grains and without furniture.
FrameView empty_view(const MapExtent& extent);

/// Whether any of it is in what is shown.
bool is_seen(const FrameView& view, const Disc& disc);
bool is_seen(const FrameView& view, const Line& line);

/// Adds a disc or a line, and in a periodic bed its images, where they reach into what is shown.
void add_disc(FrameView& view, const Disc& disc, const RunStatics& statics);
void add_line(FrameView& view, const Line& line, const RunStatics& statics);

/// A grain without its look; a grain of the floor is hatched.
Disc disc_of(const BedFrame& bed, Index grain);

/// Walls and smooth floor, where they are in what is shown, and the scale bar.
void add_surroundings(FrameView& view, const BedFrame& bed);

}  // namespace talus
