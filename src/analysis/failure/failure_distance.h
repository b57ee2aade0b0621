#pragma once
/// How far the friction of a bed is from what it can hold: the share of its critical contacts, and the bound
/// that the count of forces and equations sets to it.

#include "analysis/record.h"
#include "core/bed_frame.h"

namespace talus::analysis {

/// Layers of equal thickness by which the share is told over depth.
inline constexpr int critical_layers = 10;

/// Forces and equations of some grains.
struct ForceCount {
  double grains = 0.0;  ///< N, free grains that carry force: two equations of equilibrium each
  double turning =
      0.0;  ///< N_mu, those with a contact that has friction: one more, as a torque has to vanish
  double contacts = 0.0;  ///< M, their contacts: two components of the force each
  double critical = 0.0;  ///< those with fully mobilised friction, |f_t| = mu f_n: one component less

  /// nu; NaN without contacts.
  double share() const { return critical / contacts; }
  /// nu_max = 2 - (2 N + N_mu) / M: in equilibrium 2 M - M_critical >= 2 N + N_mu (McNamara and Herrmann
  /// 2004, Phys. Rev. E 70, 061303, where N_mu = N). NaN without contacts.
  double bound() const { return 2.0 - (2.0 * grains + turning) / contacts; }
  /// nu / nu_max; NaN where the bound is not above 0.
  double share_of_bound() const { return bound() > 0.0 ? share() / bound() : not_known; }
};

/// Of layers between the floor and `height` (m); a grain belongs to that of its centre, a higher one to the
/// last. A contact counts half for each of two free grains, and whole for one that touches a floor grain or a
/// wall, so the sum over the layers is the count of the bed.
std::vector<ForceCount> count_forces(const BedFrame& bed, double height, int layers);

/// `height`: mean height of the bed, m. Sets members of a record, defined in the table of quantities, but for
/// the share of the whole bed, which take_critical_contacts sets.
void take_failure_distance(const BedFrame& bed, double height, FrameRecord& record);

}  // namespace talus::analysis
