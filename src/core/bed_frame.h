#pragma once
/// A frame of a bed together with the constants of its run.

#include "core/snapshot.h"

namespace talus {

/// References to a frame and to the constants of its run; owns neither.
struct BedFrame {
  const Frame& frame;
  const RunStatics& statics;
};

/// Returns the displacement of grain i since an earlier frame, m, continued across a periodic edge.
inline Vec2 displacement(const BedFrame& bed, const Frame& before, Index i) {
  const double periods = bed.statics.periodic ? bed.frame.image[i] - before.image[i] : 0;
  return {bed.frame.x[i] - before.x[i] + periods * bed.statics.length, bed.frame.y[i] - before.y[i]};
}

}  // namespace talus
