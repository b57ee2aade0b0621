#pragma once
/// Growing neighbourhoods of one overloaded grain (paper, Fig. 11).

#include <optional>
#include <span>

#include "core/bed_frame.h"
#include "figures/figure.h"
#include "figures/run_group.h"

namespace talus {

/// The grain whose l_c are nearest to their means: with the smallest sum over the thresholds of
/// |l_c / mean - 1|, of the free grains that are overloaded at each of them and lie in the middle half of the
/// bed's height, and of its length between walls; of equal ones that with the smallest id. No value where
/// there is none. `thresholds`: those of the frame.
std::optional<Index> typical_grain(const BedFrame& bed, std::span<const FrameThreshold> thresholds);

/// The free grains with centres within `distance` (m) of that of a grain, in a periodic bed their nearest
/// images: x and y from that grain, and radius, in D, and gamma.
Table grains_around(const BedFrame& bed, Index centre, double distance);

/// Paper, Fig. 11: a grain that is overloaded at 10 deg, or at the nearest tilt before failure at which one
/// is, with circles about it, and gamma_l over l.
std::optional<Figure> neighbourhoods_figure(std::span<const RunGroup> groups);

}  // namespace talus
