#pragma once
/// The contacts of a frame as a network: who holds whom, forces, mobilised friction.

#include <vector>

#include "analysis/histogram.h"
#include "analysis/record.h"
#include "core/bed_frame.h"
#include "core/snapshot.h"

namespace talus::analysis {

// Each of these sets members of a record, which are defined in the table of quantities.

/// z and its like, which have 0 where no grain carries force, and the share of rattlers.
void take_coordination(const BedFrame& bed, FrameRecord& record);

/// Normal forces over their mean, counted into `bins`.
Histogram normal_forces(const Frame& frame, Histogram bins);
/// |f_t| / (mu f_n) of contact c, mu that of the contact. Above 1 (rounding) it is 1, and without friction,
/// too: such a contact can slide.
double mobilisation_of(const BedFrame& bed, Index c);
/// The same of all contacts, in equal bins from 0 to 1.
Histogram mobilised_friction(const BedFrame& bed, int bins);

/// Of each free grain, the mean over its contacts, those with floor and walls among them. NaN where it has
/// no contact.
std::vector<double> mobilised_friction_of_grains(const BedFrame& bed);

/// The mean normal force, and the contacts with more than it beside the weak others (Radjai et al. 1998). The
/// moment of contacts is the part that they have in the internal moments of the free grains; of the deviator
/// Q of all contacts the strong ones have what lies along the principal axes of the whole. The fabric of each
/// network is the second Fourier component of its directions (fabric.h).
void take_networks(const BedFrame& bed, FrameRecord& record);

/// Contacts where friction is fully mobilised (status sliding), joined where they share a free grain. Their
/// share is NaN without contacts; the mean sizes of their clusters, in contacts, and their correlation length
/// (clusters.h, of the grains that they join) are NaN where none slides.
void take_critical_contacts(const BedFrame& bed, FrameRecord& record);

}  // namespace talus::analysis
