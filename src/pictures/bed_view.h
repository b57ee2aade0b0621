#pragma once
/// The bed as a picture: what is seen of it, with copies across a periodic edge.

#include "pictures/maps.h"
#include "render/frame_view.h"

namespace talus::pictures {

/// What is shown, without grains and without furniture.
render::FrameView empty_view(const MapExtent& extent);

/// Whether any of it is in what is shown.
bool is_seen(const render::FrameView& view, const render::Disc& disc);
bool is_seen(const render::FrameView& view, const render::Line& line);

/// Adds a disc or a line, and in a periodic bed its images, where they reach into what is shown.
void add_disc(render::FrameView& view, const render::Disc& disc, const RunStatics& statics);
void add_line(render::FrameView& view, const render::Line& line, const RunStatics& statics);

/// A grain without its look; a grain of the floor is hatched.
render::Disc disc_of(const BedFrame& bed, Index grain);

/// The length of a scale bar, in mean diameters: a round one, 10 where that suits a picture so wide (m).
double scale_diameters(double width, double diameter);

/// Walls and smooth floor, where they are in what is shown, and the scale bar.
void add_surroundings(render::FrameView& view, const BedFrame& bed);

}  // namespace talus::pictures
