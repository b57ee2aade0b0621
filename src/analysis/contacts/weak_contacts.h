#pragma once
/// Weak contacts across the force chains with nearly mobilised friction, called coherent by Staron and Radjai
/// (2005).

#include <span>
#include <vector>

#include "analysis/record.h"
#include "core/bed_frame.h"

namespace talus::analysis {

/// Smallest |f_t| / (mu f_n) of a coherent weak contact. In poured beds, weak contacts above about half of it
/// lie across the strong ones, increasingly so with increasing mobilisation.
inline constexpr double coherent_mobilisation = 0.8;

/// Fabric relative to the strong contacts: 2 <cos 2 (direction - d)> over a set of contacts, where d is the
/// direction in which the strong contacts (f_n above the mean) concentrate. 2 if all are along d, 0 if
/// isotropic, -2 if all are across; NaN without contacts or without strong ones.
struct WeakContacts {
  double coherent_share = not_known;       ///< share of all force-carrying contacts
  double coherent_fabric = not_known;      ///< fabric of the coherent weak contacts
  double incoherent_fabric = not_known;    ///< fabric of the other weak contacts
  std::vector<double> fabric_by_friction;  ///< fabric of the weak contacts, binned by |f_t| / (mu f_n)
};

/// Computes the fabric of the weak contacts. `edges` are the bin edges for mobilisation_of
/// (contact_network.h).
WeakContacts weak_contacts(const BedFrame& bed, double mean_normal_force, std::span<const double> edges);

/// Sets members of a record that are defined in the table of quantities; its mean normal force must be set.
void measure_weak_contacts(const BedFrame& bed, std::span<const double> edges, FrameRecord& record);

}  // namespace talus::analysis
