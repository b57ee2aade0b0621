#pragma once
/// The visible part of the bed as a picture, with copies across a periodic edge.

#include "pictures/maps.h"
#include "render/frame_view.h"

namespace talus::pictures {

/// Returns a view of this extent, without grains and furniture.
render::FrameView empty_view(const MapExtent& extent);

/// Whether any part of a disc or line is within the view.
bool is_seen(const render::FrameView& view, const render::Disc& disc);
bool is_seen(const render::FrameView& view, const render::Line& line);

/// Add a disc or line and, in a periodic bed, its images that reach into the view.
void add_disc(render::FrameView& view, const render::Disc& disc, const RunStatics& statics);
void add_line(render::FrameView& view, const render::Line& line, const RunStatics& statics);

/// Returns the disc of a grain without its look; grains of the floor are hatched.
render::Disc disc_of(const BedFrame& bed, Index grain);

/// Returns the length of a scale bar, D: a round number, preferably 10, for a picture of this width (m).
double scale_diameters(double width, double diameter);

/// Adds the walls and the smooth floor, if they are in the view, and the scale bar.
void add_surroundings(render::FrameView& view, const BedFrame& bed);

}  // namespace talus::pictures
