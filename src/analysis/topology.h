#pragma once
/// The network of contacts as a graph that thins out as a threshold of the force rises.

#include <span>
#include <vector>

#include "analysis/record.h"
#include "core/bed_frame.h"

namespace talus {

/// Betti numbers of a graph whose vertices are the grains that its edges touch.
struct GraphCount {
  Index components = 0;
  Index loops = 0;  ///< independent ones: edges - vertices + components
};

/// Of the contacts between free grains with f_n >= each of the thresholds (N/m), which may stand in any
/// order. Exact, by union-find from the largest force down.
std::vector<GraphCount> count_networks(const BedFrame& bed, std::span<const double> thresholds);

/// Thresholds over the mean normal force of all contacts. Sets members of a record, which are defined in the
/// table of quantities.
void take_topology(const BedFrame& bed, std::span<const double> thresholds, FrameRecord& record);

}  // namespace talus
