#pragma once
/// The directions of the contacts of a frame.

#include <array>
#include <vector>

#include "analysis/histogram.h"
#include "core/snapshot.h"

namespace talus::analysis {

/// Directions of contact normals in [0, 180) deg to the bed, in equal bins; each contact counts once, or with
/// f_n.
Histogram normal_directions(const Frame& frame, int bins, bool weighted_by_force);

/// 2 <cos m (theta - theta_m)> of the directions of normals: the amplitude of the m-th Fourier component of
/// their density relative to a uniform one, and the angle theta_m of its first peak, deg in [0, 360 / m). m
/// is even: a normal and its opposite are one direction. NaN without contacts.
struct FabricComponent {
  double amplitude = 0.0;
  double angle = 0.0;
};
FabricComponent fabric_component(const Frame& frame, int m);
/// The same where contact c counts as often as weights[c] says, none of them negative; NaN where all are 0.
FabricComponent fabric_component(const FrameContacts& contacts, int m, const std::vector<double>& weights);

/// Where contact normals concentrate: the angles nearest 0, 60 and 120 deg, each within 30 deg of them, at
/// which the density of directions, smoothed with a normal distribution of 5 deg standard deviation, is
/// highest; deg, to 1 deg. NaN without contacts.
std::array<double, 3> direction_peaks(const Frame& frame);

}  // namespace talus::analysis
