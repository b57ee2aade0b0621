#pragma once
/// The contact network of a frame: coordination, forces and mobilised friction.

#include <vector>

#include "analysis/histogram.h"
#include "analysis/record.h"
#include "core/bed_frame.h"
#include "core/snapshot.h"

namespace talus::analysis {

// Each measure_ function sets members of a record that are defined in the table of quantities.

/// Sets the coordination numbers, 0 if no grain carries force, and the share of rattlers.
void measure_coordination(const BedFrame& bed, FrameRecord& record);

/// Counts the normal forces, divided by their mean, into `bins`.
Histogram normal_forces(const Frame& frame, Histogram bins);
/// Returns |f_t| / (mu f_n) of contact c with its own coefficient mu, limited to 1 against rounding. Without
/// friction it is 1 because such a contact can slide.
double mobilisation_of(const BedFrame& bed, Index c);
/// Returns the distribution of the mobilised friction over all contacts, in equal bins from 0 to 1.
Histogram mobilised_friction(const BedFrame& bed, int bins);

/// Returns the mean mobilised friction over the contacts of each free grain, including those with floor and
/// walls. NaN for a grain without contacts.
std::vector<double> mobilised_friction_of_grains(const BedFrame& bed);

/// Sets the mean normal force and the properties of the strong network, the contacts above this mean, and of
/// the weak network (Radjai et al. 1998). The stress of a network is its contribution to the internal moments
/// of the free grains. The strong share of the deviator Q is the part along the principal axes of the total.
/// The fabric of each network is the second Fourier component of its directions (fabric.h).
void measure_networks(const BedFrame& bed, FrameRecord& record);

/// Sets the quantities of critical contacts, those with fully mobilised friction (status sliding), joined
/// into clusters if they share a free grain. Their share is NaN without contacts. The mean cluster sizes, in
/// contacts, and the correlation length (clusters.h, over the grains they join) are NaN if no contact slides.
void measure_critical_contacts(const BedFrame& bed, FrameRecord& record);

}  // namespace talus::analysis
