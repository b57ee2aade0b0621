#pragma once
/// Distance of a bed from the limit of its friction: the share of critical contacts and its upper bound from
/// the number of forces and equations.

#include <span>

#include "analysis/record.h"
#include "core/snapshot.h"
#include "core/statistics.h"

namespace talus::analysis {

/// Number of layers of equal thickness for the profile of the share over depth.
inline constexpr int critical_layers = 10;

/// Numbers of forces and equations for a set of grains.
struct ForceCount {
  double grains = 0.0;    ///< N, free grains that carry force, with two force equations each
  double turning = 0.0;   ///< N_mu, grains with a frictional contact, with one torque equation each
  double contacts = 0.0;  ///< M, contacts of these grains, with two force components each
  /// Contacts with fully mobilised friction, |f_t| = mu f_n, which removes one component each.
  double critical = 0.0;

  /// Returns nu; NaN without contacts.
  double share() const { return critical / contacts; }
  /// Returns nu_max = 2 - (2 N + N_mu) / M; equilibrium requires 2 M - M_critical >= 2 N + N_mu if contacts
  /// do not resist rolling (McNamara and Herrmann 2004, Phys. Rev. E 70, 061303, where N_mu = N). NaN without
  /// contacts.
  double bound() const { return 2.0 - (2.0 * grains + turning) / contacts; }
  /// Returns nu / nu_max; NaN if the bound is not above 0.
  double share_of_bound() const { return bound() > 0.0 ? share() / bound() : not_known; }
};

/// Counts forces and equations in layers between the floor and `height` (m). A grain belongs to the layer of
/// its centre, or to the last layer if it is higher. A contact between two free grains counts half for each
/// of them, and a contact with a floor grain or wall counts fully, so the sum over the layers is the count of
/// the bed.
std::vector<ForceCount> count_forces(const BedFrame& bed, double height, int layers);

/// Sets members of a record that are defined in the table of quantities, except the share of the whole bed,
/// which measure_critical_contacts sets. `height`: mean height of the bed, m.
void measure_failure_distance(const BedFrame& bed, double height, FrameRecord& record);

// Ratio of the shear stress of a packing to that of an infinite slope, just before failure.

/// Window before theta_c that analyses use for failure_ratio, deg.
inline constexpr double failure_window = 0.5;

/// Returns the statistics of (sigma_T / sigma_N) / tan(theta), 1 for a periodic bed and less between walls
/// (paper, Eq. 15 and Fig. 7), over the last `window` (rad) before theta_c (rad). `tilts` (rad) and `ratios`,
/// sigma_T / sigma_N, correspond row by row. NaN if the slope has not failed.
Statistics failure_ratio(std::span<const double> tilts, std::span<const double> ratios, double theta_c,
                         double window);

}  // namespace talus::analysis
