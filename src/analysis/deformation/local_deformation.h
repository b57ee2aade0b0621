#pragma once
/// How the neighbourhood of each grain deforms between two frames, and what of its motion is no deformation.

#include <vector>

#include "analysis/record.h"
#include "core/bed_frame.h"

namespace talus::analysis {

/// A grain's neighbours are the grains, those of the floor among them, whose centres lie within this of its
/// own, in D: the first two shells.
inline constexpr double deformation_reach = 2.0;

/// The share of the grains that strain most, by which localisation is told.
inline constexpr double most_strained = 0.1;

/// Of the neighbours of one grain. All NaN where they do not span the plane: fewer than two, or in one line.
struct LocalDeformation {
  /// G = F - 1, the gradient of displacements du_i / dX_j that fits those of the neighbours, seen from the
  /// grain, best.
  Tensor2 gradient{not_known, not_known, not_known, not_known};
  /// D2min of Falk and Langer (1998): the mean over the neighbours of the square of what is left, m^2. Theirs
  /// is the sum.
  double nonaffine = not_known;
};

/// Of each free grain, from frame `before` to frame `bed`, with the neighbours that it had before (T27),
/// (T28). Displacements are unrolled over the period; of periodic images the nearest counts. NaN throughout
/// where the two frames have not the same grains.
std::vector<LocalDeformation> local_deformations(const Frame& before, const BedFrame& bed);

// Of F = 1 + G = R U, a stretch U with principal values s1 >= s2 and then a turn R: exact also where grains
// go far. A motion of all neighbours as one rigid body has no strain. (T29)

/// s1 - s2 >= 0: the shear of a simple shear.
double shear_strain(const Tensor2& gradient);
/// Change of area over area, det F - 1; negative where the neighbourhood contracts.
double area_strain(const Tensor2& gradient);
/// Twice the angle of R, rad, counter-clockwise positive: the curl of displacements where they are small.
double vorticity(const Tensor2& gradient);

/// Sets members of a record, defined in the table of quantities.
void take_deformation(const Frame& before, const BedFrame& bed, FrameRecord& record);

}  // namespace talus::analysis
