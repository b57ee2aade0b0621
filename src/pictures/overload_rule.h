#pragma once
/// When a grain is overloaded, and the clusters of those that are.

#include "analysis/overload/clusters.h"
#include "analysis/overload/coarse_graining.h"
#include "core/bed_frame.h"

namespace talus::pictures {

/// By what maps, traces and curves call a grain overloaded, and join overloaded grains to clusters.
struct OverloadRule {
  double theta_c = 0.0;               ///< rad, angle of repose: Gamma_c = sin(theta_c)
  double threshold_factor = 1.0;      ///< grains are overloaded from this times Gamma_c on
  bool joined_by_neighbours = false;  ///< grains closer than 1.1 times the sum of their radii join, instead
                                      ///< of those that touch with a force
  double l_min = analysis::default_l_min;  ///< D: diameter of the neighbourhood whose stress ratio is the
                                           ///< gamma of a grain; 0: the grain alone
  bool operator==(const OverloadRule&) const = default;
};

/// Stress ratio from which on a grain is overloaded: threshold_factor times sin(theta_c).
double threshold_of(const OverloadRule& rule);

/// A frame as its maps see it: gamma of a grain is that of its neighbourhood of diameter `l_min` (D). Maps,
/// traces and clusters are all made from such a frame.
Frame mapped_frame(Frame frame, const RunStatics& statics, double l_min);

/// Clusters of the overloaded free grains of a frame of mapped_frame: what the map `clusters` and
/// ClusterColours go by.
analysis::Clusters overloaded_clusters(const BedFrame& bed, const OverloadRule& rule);

}  // namespace talus::pictures
