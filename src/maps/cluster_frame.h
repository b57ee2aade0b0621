#pragma once
/// The clusters of overloaded grains that maps and traces show.

#include "analysis/clusters.h"
#include "core/snapshot.h"
#include "maps/maps.h"

namespace talus {

/// Stress ratio from which on a grain is overloaded: threshold_factor times sin(theta_c).
double overload_threshold(const MapSettings& settings);

/// Clusters of the overloaded free grains of a frame of mapped_frame, joined as the settings say: what the
/// map `clusters` and ClusterColours go by.
Clusters overloaded_clusters(const Frame& frame, const RunStatics& statics, const MapSettings& settings);

}  // namespace talus
