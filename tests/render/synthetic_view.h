#pragma once
/// The map of a made-up bed.

#include "maps/maps.h"
#include "render/synthetic_bed.h"

namespace talus::test {

inline constexpr double synthetic_theta_c = 0.35;  ///< rad

inline FrameView synthetic_view(MapKind kind, int columns = 40, int rows = 10, bool periodic = true) {
  const SyntheticBed bed = make_synthetic_bed(columns, rows, periodic);
  MapExtent extent;
  extend(extent, bed.frame, bed.statics);
  return make_map(bed.frame, bed.statics, kind, synthetic_theta_c, extent);
}

}  // namespace talus::test
