#pragma once
/// Local strain and non-affine displacement of the neighbourhood of each grain between two frames.

#include <vector>

#include "analysis/record.h"
#include "core/bed_frame.h"

namespace talus::analysis {

/// Radius of the neighbourhood of a grain, in D: neighbours are the grains, floor grains included, with
/// centres within this distance of its own, the first two shells.
inline constexpr double deformation_reach = 2.0;

/// Share of the grains, those with the largest strain, whose part of the total strain measures localisation.
inline constexpr double most_strained_share = 0.1;

/// Deformation of the neighbours of one grain. NaN if they do not span the plane: fewer than two, or in one
/// line.
struct LocalDeformation {
  /// G = F - 1, the gradient of displacements du_i / dX_j that best fits those of the neighbours relative to
  /// the grain.
  Tensor2 gradient{not_known, not_known, not_known, not_known};
  /// D2min of Falk and Langer (1998), m^2, here the mean over the neighbours of the squared residual; theirs
  /// is the sum.
  double nonaffine = not_known;
};

/// Returns the deformation of each free grain from frame `before` to frame `bed`, with the neighbours in the
/// earlier frame (T27), (T28). Displacements are unwrapped across the period; only the nearest periodic image
/// of a neighbour counts. NaN throughout if the two frames do not have the same grains.
std::vector<LocalDeformation> local_deformations(const Frame& before, const BedFrame& bed);

// Strain measures of F = 1 + G = R U, a stretch U with principal values s1 >= s2 followed by a rotation R.
// They are exact for large displacements, and a rigid motion of all neighbours has no strain. (T29)

/// Returns s1 - s2 >= 0, which for simple shear is the shear strain.
double shear_strain(const Tensor2& gradient);
/// Returns the relative change of area, det F - 1; negative if the neighbourhood contracts.
double area_strain(const Tensor2& gradient);
/// Returns twice the angle of R, rad, counter-clockwise positive; for small displacements this is their curl.
double vorticity(const Tensor2& gradient);

/// Sets members of a record that are defined in the table of quantities.
void measure_deformation(const Frame& before, const BedFrame& bed, FrameRecord& record);

}  // namespace talus::analysis
