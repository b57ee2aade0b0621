#pragma once
/// Coarse graining of grain stresses: the stress ratio of a grain together with its neighbours, and the size
/// at which the neighbourhood of an overloaded grain is no longer overloaded (paper, section V B).

#include <optional>
#include <span>
#include <vector>

#include "analysis/record.h"
#include "core/snapshot.h"

namespace talus::analysis {

/// Returns the frame with the gamma of each free grain replaced by gamma_l at l = l_min (m). The
/// neighbourhood of diameter l of a grain consists of all free grains, itself included, whose centres or
/// nearest periodic images lie within l/2 of its centre; gamma_l is the stress ratio of the sum of their
/// internal moments (T24). A grain that carries nothing itself keeps NaN. With l_min = 0, the single grain as
/// printed in the paper, the frame is returned unchanged.
Frame with_gamma_of_neighbourhoods(Frame frame, const RunStatics& statics, double l_min);

/// Returns the diameter at which the search for l_c ends, m: `cut` (D), by default min(H, L/2). It is at most
/// the period of a periodic bed, beyond which neighbourhoods are incomplete, and at least l_min (D).
double length_cut(const RunStatics& statics, double l_min, std::optional<double> cut = std::nullopt);

/// Rule for l_c, the smallest l >= l_min at which gamma_l <= `end_ratio` (T25).
struct CoarseGrainingRule {
  double threshold = 0.0;  ///< a grain is overloaded if its gamma is at least this
  double end_ratio = 0.0;  ///< equal to the threshold in the paper
  double l_min = 0.0;      ///< m; the value with which the gamma of the frame was computed
  double cut = 0.0;        ///< m; see length_cut
};

/// Coarse-graining lengths l_c of the overloaded grains of a frame.
struct CoarseGraining {
  /// l_c of each free grain, a diameter, m; NaN if the grain is not overloaded; the cut if gamma_l stays
  /// above the end ratio up to there.
  std::vector<double> length;
  Index overloaded = 0;
  Index cut_off = 0;  ///< number of overloaded grains that reach the cut
  /// Mean l_c of the overloaded grains, with the cut for those that reach it; NaN without any.
  double mean = 0.0;
  double largest = 0.0;
  double standard_error = 0.0;  ///< standard error of the mean, for independent grains
};

/// Returns l_c of all overloaded grains. The gamma of the frame comes from with_gamma_of_neighbourhoods with
/// the l_min of the rule.
CoarseGraining coarse_graining(const BedFrame& bed, const CoarseGrainingRule& rule);

/// Returns gamma_l of every free grain at the diameter l (m); NaN if the neighbourhood carries nothing.
std::vector<double> coarse_stress_ratio(const BedFrame& bed, double l);

/// Returns p_o as a function of the size of neighbourhoods: the share of the free grains that carry something
/// with gamma_l >= threshold, at each of the diameters `l` (m, ascending). The frame has the gamma of single
/// grains. NaN if no grain carries anything.
std::vector<double> overloaded_over_scale(const BedFrame& bed, double threshold, std::span<const double> l);

/// gamma_l over l for one grain, with one point for each distance at which grains join the neighbourhood, up
/// to the diameter `largest` (m); Fig. 11 of the paper.
struct NeighbourhoodCurve {
  std::vector<double> l, gamma;
};
/// Returns the curve of one free grain.
NeighbourhoodCurve neighbourhood_curve(const BedFrame& bed, Index grain, double largest);

}  // namespace talus::analysis
