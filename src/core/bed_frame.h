#pragma once
/// A frame of a bed, which says little without what does not change during the run.

#include "core/snapshot.h"

namespace talus {

/// Both travel as one; it holds neither.
struct BedFrame {
  const Frame& frame;
  const RunStatics& statics;
};

}  // namespace talus
