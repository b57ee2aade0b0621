#pragma once
/// A bed whose tilt goes up and down: loops over the tilt, and what is left of each cycle.

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "figures/figure.h"
#include "figures/run_group.h"

namespace talus {

/// A cycle of a course of the tilt: from one place where the tilt begins to rise to the next.
struct TiltCycle {
  std::size_t first = 0;  ///< its first place, which is the last one of the cycle before it
  std::size_t last = 0;
  std::size_t top = 0;     ///< the last of its places with the highest tilt
  bool is_closed = false;  ///< the tilt has fallen after the top
};

/// The cycles of tilts in the order of time. A tilt that only falls, or is held, is one cycle as well; none
/// for no tilts.
std::vector<TiltCycle> cycles_of(std::span<const double> tilts);

/// Of the first group whose runs have a programme of the tilt, and files; nothing where there is none.
std::optional<Figure> cycles_figure(std::span<const RunGroup> groups);

}  // namespace talus
