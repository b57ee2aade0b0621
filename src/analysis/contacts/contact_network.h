#pragma once
/// The contact network of a frame: coordination, forces and mobilised friction.

#include <span>
#include <vector>

#include "analysis/histogram.h"
#include "analysis/record.h"
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
/// The fabric of each network is the second Fourier component of its directions (texture.h).
void measure_networks(const BedFrame& bed, FrameRecord& record);

/// Sets the quantities of critical contacts, those with fully mobilised friction (status sliding), joined
/// into clusters if they share a free grain. Their share is NaN without contacts. The mean cluster sizes, in
/// contacts, and the correlation length (clusters.h, over the grains they join) are NaN if no contact slides.
void measure_critical_contacts(const BedFrame& bed, FrameRecord& record);

// Weak contacts across the force chains with nearly mobilised friction, called coherent by Staron and Radjai
// (2005).

/// Smallest |f_t| / (mu f_n) of a coherent weak contact. In poured beds, weak contacts above about half of it
/// lie across the strong ones, increasingly so with increasing mobilisation.
inline constexpr double coherent_mobilisation = 0.8;

/// Sets the share of the coherent weak contacts, and the fabric of these, of the other weak contacts, and of
/// the weak contacts in each bin of mobilisation_of with these `edges`. Fabric is relative to the strong
/// contacts: 2 <cos 2 (direction - d)> over a set of contacts, where d is the direction in which the strong
/// contacts (f_n above the mean) concentrate. 2 if all are along d, 0 if isotropic, -2 if all are across; NaN
/// without contacts or without strong ones. The mean normal force of the record must be set.
void measure_weak_contacts(const BedFrame& bed, std::span<const double> edges, FrameRecord& record);

// Contacts gained and lost between two frames of a bed.

/// Contacts gained and lost from one frame to another.
struct ContactChanges {
  std::vector<Index> gained;  ///< indices into the contacts of the later frame, ascending
  std::vector<Index> lost;    ///< indices into those of the earlier frame, ascending
};

/// Compares the contacts of two frames of the same grains, in either order of time. Frames store contacts
/// that carry force. Contacts are the same if they connect the same two bodies and, in a periodic bed, the
/// same images, whichever side of the edge these have moved to. Throws Error(internal) if the frames have
/// different numbers of grains.
ContactChanges contact_changes(const Frame& before, const Frame& after);

}  // namespace talus::analysis
