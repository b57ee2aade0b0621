#pragma once
/// How much of the shear stress each anisotropy of the contacts carries: that of their directions, of their
/// forces, and of the distances that they bridge.

#include "analysis/record.h"
#include "core/bed_frame.h"

namespace talus::analysis {

/// Anisotropies about the major principal direction of the stress of the contact forces, each the amplitude
/// of a cosine (of tangential forces, a sine) of twice the angle to it (Rothenburg and Bathurst 1989). Those
/// of forces and lengths are found from sums over contacts weighted by them, less that of the contacts. NaN
/// without contacts.
struct Texture {
  double axis = 0.0;               ///< rad
  double contacts = 0.0;           ///< a_c
  double normal_forces = 0.0;      ///< a_n
  double tangential_forces = 0.0;  ///< a_t, positive where friction adds to Gamma
  double branches = 0.0;           ///< a_l

  /// Gamma to first order in the anisotropies.
  double stress_ratio() const { return 0.5 * (contacts + normal_forces + tangential_forces + branches); }
};
Texture texture_of(const BedFrame& bed);

/// Sets members of a record, which are defined in the table of quantities.
void take_texture(const BedFrame& bed, FrameRecord& record);

}  // namespace talus::analysis
