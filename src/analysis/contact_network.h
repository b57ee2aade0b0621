#pragma once
/// The contacts of a frame as a network: who holds whom, forces, mobilised friction.

#include "analysis/histogram.h"
#include "core/snapshot.h"

namespace talus {

/// Contacts with force per free grain; each contact counts for each free grain it touches.
struct Coordination {
  double carrying = 0.0;          ///< z over grains that carry force
  double all = 0.0;               ///< over all free grains
  double without_rattlers = 0.0;  ///< over the backbone: grains with fewer than two contacts taken away,
                                  ///< again and again, with their contacts
  double rattler_fraction = 0.0;  ///< share of the free grains that are not in the backbone
};
Coordination coordination(const Frame& frame, const RunStatics& statics);

/// Normal forces over their mean, counted into `bins`.
Histogram normal_forces(const Frame& frame, Histogram bins);
/// |f_t| / (mu f_n), mu that between grains, in equal bins from 0 to 1. Values above 1 (rounding) count as 1.
Histogram mobilised_friction(const Frame& frame, const RunStatics& statics, int bins);

/// Contacts with more than the mean normal force, and the weak others (Radjai et al. 1998). The moment of
/// contacts is the part that they have in the internal moments of the free grains.
struct Networks {
  double mean_normal_force = 0.0;     ///< N (per metre of thickness)
  double strong_share = 0.0;          ///< of the contacts
  double strong_share_of_mean = 0.0;  ///< of the trace P of the moment of all contacts
  /// Of its deviator Q: what the strong moment has of it along the principal axes of the whole. The weak
  /// contacts have the rest.
  double strong_share_of_deviator = 0.0;
  double strong_ratio = 0.0;  ///< Q/P of the moment of the strong contacts alone
  double weak_ratio = 0.0;    ///< of the weak ones
};
Networks networks(const Frame& frame, const RunStatics& statics);

/// Contacts where friction is fully mobilised (status sliding), joined where they share a free grain.
struct CriticalContacts {
  double share = 0.0;               ///< of the contacts with force; NaN without contacts
  Index largest_cluster = 0;        ///< contacts
  double correlation_length = 0.0;  ///< m, of clusters.h, for the grains that they join; NaN without any
};
CriticalContacts critical_contacts(const Frame& frame, const RunStatics& statics);

}  // namespace talus
