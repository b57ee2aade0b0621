#pragma once
/// Directions of the contact normals of a frame.

#include <array>
#include <vector>

#include "analysis/histogram.h"
#include "core/snapshot.h"

namespace talus::analysis {

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
/// Computes the component with each contact counted once.
FabricComponent fabric_component(const Frame& frame, int m);
/// Computes the same with contact c weighted by weights[c] >= 0; NaN if all weights are 0.
FabricComponent fabric_component(const FrameContacts& contacts, int m, const std::vector<double>& weights);

/// Returns the preferred directions of contact normals, in whole degrees: the angles within 30 deg of 0, 60
/// and 120 deg at which the density of directions, smoothed with a normal distribution of 5 deg standard
/// deviation, is highest. NaN without contacts.
std::array<double, 3> direction_peaks(const Frame& frame);

}  // namespace talus::analysis
