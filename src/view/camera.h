#pragma once
/// What part of the bed a picture shows.

#include "pictures/maps.h"
#include "view/view_state.h"

namespace talus::view {

/// The camera with its zoom not below 1, where all of the bed is seen, and not above what leaves 3 D, and its
/// centre in the bed.
ViewCamera clamped(const ViewCamera& camera, const pictures::MapExtent& bed, double mean_diameter);

/// Width over height of a picture in which a part 1 long and `depth` deep just has room, turned by up to
/// `turn_max` (rad, >= 0).
double picture_aspect(double depth, double turn_max);

/// The part of the bed that fills a picture of that aspect (width / height). With zoom 1 it is all of the
/// bed, and what is left of the picture is beside it; else no more is shown beyond an end of the bed than
/// there has to be. `turn_max` (rad, >= 0): the part is drawn turned by up to that angle, and all of it is to
/// fit.
pictures::MapExtent shown_part(const ViewCamera& camera, const pictures::MapExtent& bed, double mean_diameter,
                               double aspect, double turn_max);

/// The camera in the middle of what it shows, so that a centre moved on at an end of the bed moves back at
/// once.
ViewCamera centred(const ViewCamera& camera, const pictures::MapExtent& part);

/// What of one is within the other.
pictures::MapExtent common_part(const pictures::MapExtent& one, const pictures::MapExtent& other);

}  // namespace talus::view
