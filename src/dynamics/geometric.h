#pragma once
/// Deposition by geometry: grains are set down one after another, each where it comes to rest on those before
/// it (Visscher and Bolsterli 1972, Nature 239, 504). No forces: Contact Dynamics finds them afterwards.

#include "dynamics/bed.h"

namespace talus::dynamics {

/// How a grain finds its place.
struct GeometricRule {
  /// rad, in [0, pi/2]: a grain stays where it has fallen on another one at a smaller angle between contact
  /// normal and vertical (Bratberg, Radjai and Hansen 2002, Phys. Rev. E 66, 031303); 0: it always rolls into
  /// a local minimum of height, pi/2: it never does.
  double critical_angle = 0.0;
  int sites = 1;  ///< places that are tried, of which the lowest is kept
};

/// A bed at rest, with ids in the order of setting down. Grains fall at random places along the bed, between
/// walls as far from them as their size asks. No two bodies overlap, to round-off. The same for the same plan
/// and rule, everywhere. The bed is longer than four of its largest grains.
World make_geometric_bed(const BedPlan& plan, const GeometricRule& rule);

}  // namespace talus::dynamics
