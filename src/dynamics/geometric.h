#pragma once
/// Geometric deposition: grains are placed one after another, each at its position of rest on the earlier
/// ones (Visscher and Bolsterli 1972, Nature 239, 504). Contact Dynamics determines the forces afterwards.

#include "dynamics/bed.h"

namespace talus::dynamics {

/// Rule by which a grain finds its position.
struct GeometricRule {
  /// Critical angle between contact normal and vertical, rad, in [0, pi/2]: a grain that lands on another one
  /// at a smaller angle stays there (Bratberg, Radjai and Hansen 2002, Phys. Rev. E 66, 031303). With 0 it
  /// always rolls into a local minimum of height, with pi/2 never.
  double critical_angle = 0.0;
  int sites = 1;  ///< number of positions tried, of which the lowest is kept
};

/// Returns a bed at rest, with ids in the order of deposition. Grains fall at random positions along the bed,
/// at least their radius away from walls. No two bodies overlap beyond round-off. The same plan and rule give
/// the same bed on every platform. The bed must be longer than four of its largest grains.
World make_geometric_bed(const BedPlan& plan, const GeometricRule& rule);

}  // namespace talus::dynamics
