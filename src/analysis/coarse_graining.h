#pragma once
/// Coarse graining of the grain stresses: how large a neighbourhood of an overloaded grain has to be before
/// it is not overloaded any more (paper, section V B).

#include <vector>

#include "core/snapshot.h"

namespace talus {

/// The neighbourhood of diameter l of a grain is all free grains whose centre, or its nearest periodic image,
/// lies within l/2 of its own, itself among them; gamma_l is the stress ratio of the sum of their internal
/// moments. l_c is the smallest l at which gamma_l <= `end_ratio`.
struct CoarseGrainingRule {
  double threshold = 0.0;  ///< a grain is overloaded from this gamma on
  double end_ratio = 0.0;  ///< in the paper the same
  double cut = 0.0;  ///< m, a diameter: ends the search; beyond the period of a periodic bed neighbourhoods
                     ///< are not whole
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

/// l_c of all overloaded grains.
CoarseGraining coarse_graining(const Frame& frame, const RunStatics& statics, const CoarseGrainingRule& rule);

/// gamma_l of every free grain at the diameter l (m). NaN where the neighbourhood carries nothing.
std::vector<double> coarse_stress_ratio(const Frame& frame, const RunStatics& statics, double l);

/// gamma_l over l for one grain, a point for each distance at which the neighbourhood takes in grains, up to
/// the diameter `largest` (m). The paper's Fig. 11.
struct NeighbourhoodCurve {
  std::vector<double> l, gamma;
};
NeighbourhoodCurve neighbourhood_curve(const Frame& frame, const RunStatics& statics, Index grain,
                                       double largest);

}  // namespace talus
