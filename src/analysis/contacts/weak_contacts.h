#pragma once
/// The weak contacts that stand across the force chains: those whose friction is nearly mobilised, which
/// Staron and Radjai (2005) call coherent.

#include <span>
#include <vector>

#include "analysis/record.h"
#include "core/bed_frame.h"

namespace talus::analysis {

/// From which |f_t| / (mu f_n) on a weak contact counts as coherent: from half of it on weak contacts of
/// poured beds stand across the strong ones, the more so the more of their friction is mobilised.
inline constexpr double coherent_mobilisation = 0.8;

/// Fabric along the strong contacts: 2 <cos 2 (direction - d)> over some contacts, d the direction in which
/// the strong ones (f_n above the mean) concentrate. 2 where all point along d, 0 where they point anywhere,
/// -2 where all stand across; NaN without contacts, or without strong ones.
struct WeakContacts {
  double coherent_share = not_known;       ///< of all force-carrying contacts
  double coherent_fabric = not_known;      ///< of the coherent weak contacts
  double incoherent_fabric = not_known;    ///< of the other weak contacts
  std::vector<double> fabric_by_friction;  ///< of weak contacts, by their |f_t| / (mu f_n)
};

/// `edges` of the bins of mobilisation_of (contact_network.h).
WeakContacts weak_contacts(const BedFrame& bed, double mean_normal_force, std::span<const double> edges);

/// Sets members of a record, which are defined in the table of quantities; its mean normal force is known.
void take_weak_contacts(const BedFrame& bed, std::span<const double> edges, FrameRecord& record);

}  // namespace talus::analysis
