#pragma once
/// Coarse graining of the grain stresses: the stress ratio of a grain together with its neighbours, and how
/// large a neighbourhood of an overloaded grain has to be before it is not overloaded any more (paper,
/// section V B).

#include <optional>
#include <span>
#include <vector>

#include "core/bed_frame.h"
#include "core/snapshot.h"

namespace talus::analysis {

/// l_min, in D, that is used unless another is asked for: a grain together with its first neighbours.
inline constexpr double default_l_min = 3.0;

/// The neighbourhood of diameter l of a grain is all free grains whose centre, or its nearest periodic image,
/// lies within l/2 of its own, itself among them; gamma_l is the stress ratio of the sum of their internal
/// moments (T24). Neighbourhoods begin at the diameter l_min (m): returns the frame with gamma_l at l = l_min
/// in place of the gamma of each free grain. A grain that carries nothing itself keeps NaN. With l_min = 0,
/// the bare grain as the paper prints it, the frame is returned as it is.
Frame with_gamma_of_neighbourhoods(Frame frame, const RunStatics& statics, double l_min);

/// The diameter at which the search for l_c ends, m: `cut` (D), min(H, L/2) without a value; not above the
/// period of a periodic bed, beyond which neighbourhoods are not whole, and not below l_min (D).
double length_cut(const RunStatics& statics, double l_min, std::optional<double> cut = std::nullopt);

/// How l_c is found: it is the smallest l >= l_min at which gamma_l <= `end_ratio` (T25).
struct CoarseGrainingRule {
  double threshold = 0.0;  ///< a grain is overloaded from this gamma of the frame on
  double end_ratio = 0.0;  ///< in the paper the same
  double l_min = 0.0;      ///< m: the one with which the frame was made
  double cut = 0.0;        ///< m: that of length_cut
};

struct CoarseGraining {
  std::vector<double> length;  ///< l_c of each free grain, m, a diameter; NaN where it is not overloaded;
                               ///< the cut where gamma_l is above the end ratio up to there
  Index overloaded = 0;
  Index cut_off = 0;  ///< overloaded grains that reach the cut
  double mean = 0.0;  ///< of l_c over overloaded grains, those cut off counting with the cut; NaN without any
  double largest = 0.0;
  double standard_error = 0.0;  ///< of the mean, as if grains were independent
};

/// l_c of all overloaded grains. `frame` is one of with_gamma_of_neighbourhoods, made with the l_min of the
/// rule.
CoarseGraining coarse_graining(const BedFrame& bed, const CoarseGrainingRule& rule);

/// gamma_l of every free grain at the diameter l (m). NaN where the neighbourhood carries nothing.
std::vector<double> coarse_stress_ratio(const BedFrame& bed, double l);

/// p_o over the size of neighbourhoods: of the free grains that carry something, the share with gamma_l >=
/// threshold at each of the diameters `l` (m, ascending). `frame` has the gamma of single grains. NaN where
/// no grain carries anything.
std::vector<double> overloaded_over_scale(const BedFrame& bed, double threshold, std::span<const double> l);

/// gamma_l over l for one grain, a point for each distance at which the neighbourhood takes in grains, up to
/// the diameter `largest` (m). The paper's Fig. 11.
struct NeighbourhoodCurve {
  std::vector<double> l, gamma;
};
NeighbourhoodCurve neighbourhood_curve(const BedFrame& bed, Index grain, double largest);

}  // namespace talus::analysis
