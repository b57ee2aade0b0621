#pragma once
/// A frame of a bed, which says little without what does not change during the run.

#include "core/snapshot.h"

namespace talus {

/// Both travel as one; it holds neither.
struct BedFrame {
  const Frame& frame;
  const RunStatics& statics;
};

/// How far grain i has moved since an earlier frame, across a periodic edge where it went through one, m.
inline Vec2 displacement(const BedFrame& bed, const Frame& before, Index i) {
  const double periods = bed.statics.periodic ? bed.frame.image[i] - before.image[i] : 0;
  return {bed.frame.x[i] - before.x[i] + periods * bed.statics.length, bed.frame.y[i] - before.y[i]};
}

}  // namespace talus
