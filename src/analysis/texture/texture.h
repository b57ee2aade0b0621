#pragma once
/// Decomposition of the shear stress into the anisotropies of the contact directions, the forces and the
/// branch lengths.

#include "analysis/record.h"
#include "core/bed_frame.h"

namespace talus::analysis {

/// Anisotropies about the major principal direction of the stress of the contact forces (Rothenburg and
/// Bathurst 1989). Each is the amplitude of the cosine, or for tangential forces the sine, of twice the angle
/// to this direction. a_n and a_l are the anisotropies of the contacts weighted by normal force and by branch
/// length, less a_c; a_t is relative to the sum of the normal forces. NaN without contacts.
struct Texture {
  double axis = 0.0;               ///< rad
  double contacts = 0.0;           ///< a_c
  double normal_forces = 0.0;      ///< a_n
  double tangential_forces = 0.0;  ///< a_t, positive if friction adds to Gamma
  double branches = 0.0;           ///< a_l

  /// Returns Gamma to first order in the anisotropies.
  double stress_ratio() const { return 0.5 * (contacts + normal_forces + tangential_forces + branches); }
};
/// Computes the anisotropies of a frame.
Texture texture_of(const BedFrame& bed);

/// Sets members of a record that are defined in the table of quantities.
void measure_texture(const BedFrame& bed, FrameRecord& record);

}  // namespace talus::analysis
