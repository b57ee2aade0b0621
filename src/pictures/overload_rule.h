#pragma once
/// The definition of overloaded grains and of their clusters.

#include "analysis/overload/clusters.h"
#include "analysis/overload/coarse_graining.h"
#include "core/bed_frame.h"

namespace talus::pictures {

/// The rule by which maps, traces and curves consider a grain overloaded, and join overloaded grains into
/// clusters.
struct OverloadRule {
  double theta_c = 0.0;                    ///< rad, angle of repose: Gamma_c = sin(theta_c)
  double threshold_factor = 1.0;           ///< threshold of overloaded grains over Gamma_c
  bool joined_by_neighbours = false;       ///< join grains closer than 1.1 times the sum of their radii, not
                                           ///< only those that touch with a force
  double l_min = analysis::default_l_min;  ///< D: diameter of the neighbourhood whose stress ratio is the
                                           ///< gamma of a grain; 0: the grain alone
  bool operator==(const OverloadRule&) const = default;
};

/// Returns the threshold of the stress ratio of overloaded grains: threshold_factor times sin(theta_c).
double threshold_of(const OverloadRule& rule);

/// Returns a frame as its maps see it: gamma of a grain is that of its neighbourhood of diameter `l_min` (D).
/// Maps, traces and clusters are all made from such a frame.
Frame mapped_frame(Frame frame, const RunStatics& statics, double l_min);

/// Returns the clusters of the overloaded free grains of a frame of mapped_frame, as the map `clusters` and
/// ClusterColours use them.
analysis::Clusters overloaded_clusters(const BedFrame& bed, const OverloadRule& rule);

}  // namespace talus::pictures
