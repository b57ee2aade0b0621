#pragma once
/// Decomposition of the shear stress into the anisotropies of the contact directions, the forces and the
/// branch lengths.

#include <array>
#include <vector>

#include "analysis/free_grains.h"
#include "analysis/histogram.h"
#include "analysis/record.h"
#include "core/snapshot.h"

namespace talus::analysis {

// Contribution of a contact to the internal moments of the free grains.

/// Adds the contribution of contact c to the sum of the internal moments of the free grains, branch vector
/// times force (T19), J per metre of thickness.
inline void add_moment(const BedFrame& bed, Index c, Tensor2& sum) {
  const FrameContacts& contacts = bed.frame.contacts;
  const Vector2 n{contacts.nx[c], contacts.ny[c]}, t{-contacts.ny[c], contacts.nx[c]};
  const Vector2 f = contacts.fn[c] * n + contacts.ft[c] * t;
  matrix(sum) += branch_length(bed, c) * n * f.transpose();
}

// Directions of the contact normals of a frame.

/// Returns the distribution of the directions of contact normals in [0, 180) deg relative to the bed, in
/// equal bins. Each contact counts once, or with the weight f_n.
Histogram normal_directions(const Frame& frame, int bins, bool weighted_by_force);

/// Amplitude 2 <cos m (theta - theta_m)> of the m-th Fourier component of the density of contact normals
/// relative to a uniform density, and the angle theta_m of its first peak, deg in [0, 360 / m). m is even
/// because a normal and its opposite are one direction. NaN without contacts.
struct FabricComponent {
  double amplitude = 0.0;
  double angle = 0.0;
};
/// Computes the component, with contact c weighted by weights[c] >= 0; without weights each counts once. NaN
/// if all weights are 0.
FabricComponent fabric_component(const FrameContacts& contacts, int m,
                                 const std::vector<double>& weights = {});

/// Returns the preferred directions of contact normals, in whole degrees: the angles within 30 deg of 0, 60
/// and 120 deg at which the density of directions, smoothed with a normal distribution of 5 deg standard
/// deviation, is highest. NaN without contacts.
std::array<double, 3> direction_peaks(const Frame& frame);

/// Sets the anisotropies about the major principal direction of the stress of the contact forces (Rothenburg
/// and Bathurst 1989). Each is the amplitude of the cosine, or for tangential forces the sine, of twice the
/// angle to this direction. a_n and a_l are the anisotropies of the contacts weighted by normal force and by
/// branch length, less a_c; a_t is relative to the sum of the normal forces, positive if friction adds to
/// Gamma. NaN without contacts.
void measure_texture(const BedFrame& bed, FrameRecord& record);

}  // namespace talus::analysis
