#pragma once
/// Part of the bed that a picture shows.

#include "pictures/maps.h"
#include "view/view_state.h"

namespace talus::view {

/// Returns the camera with its zoom limited to [1, zoom that shows 3 D], and its centre inside the bed. Zoom
/// 1 shows the entire bed.
ViewCamera clamped(const ViewCamera& camera, const pictures::MapExtent& bed, double mean_diameter);

/// Returns the aspect (width / height) of the smallest picture that holds a part of length 1 and depth
/// `depth`, turned by up to `turn_max` (rad, >= 0).
double picture_aspect(double depth, double turn_max);

/// Returns the part of the bed that fills a picture of that aspect (width / height). At zoom 1 it contains
/// the entire bed, with empty space around it; at other zooms it extends beyond the ends of the bed only as
/// far as it must. The part fits even if it is drawn turned by up to `turn_max` (rad, >= 0).
pictures::MapExtent shown_part(const ViewCamera& camera, const pictures::MapExtent& bed, double mean_diameter,
                               double aspect, double turn_max);

/// Returns the camera moved to the middle of the part that it shows. A centre pushed beyond an end of the bed
/// then moves back at once.
ViewCamera centred(const ViewCamera& camera, const pictures::MapExtent& part);

/// Returns the intersection of two parts.
pictures::MapExtent common_part(const pictures::MapExtent& one, const pictures::MapExtent& other);

}  // namespace talus::view
