#pragma once
/// What a user can choose about an analysis, as plain data.

#include <optional>
#include <vector>

#include "analysis/overload/coarse_graining.h"

namespace talus::analysis {

/// What joins two overloaded grains to a cluster.
enum class Joining {
  contacts,    ///< a contact with force
  neighbours,  ///< centres closer than 1.1 times the sum of the radii
};

struct AnalysisParameters {
  std::vector<double> threshold_factors = {1.0, 2.0};  ///< thresholds over Gamma_c, ascending
  std::optional<double> gamma_c;                       ///< without a value: sin(theta_c) of the run
  double l_min = default_l_min;     ///< D: diameter at which neighbourhoods begin; 0: the bare grain
  std::optional<double> lc_factor;  ///< end of l_c over Gamma_c; without a value: as above
  std::optional<double> lc_cut;     ///< D; without a value: min(H, L/2)
  Joining joining = Joining::contacts;
  double averaging =
      0.0;               ///< deg of tilt over which the internal moment of a grain is averaged; 0: one frame
  int min_contacts = 1;  ///< force-carrying contacts that a grain must have to count
  int sections = 20;
  int bins = 50;
  std::optional<double> event_velocity;  ///< g h; without a value: from the tolerance of the solver
  double event_quiet = 1.0;              ///< sqrt(D/g) below it, after which an event is over
  double event_displacement = 0.01;      ///< D from which on a grain counts as moved
  std::optional<double> event_size_min;  ///< m g D where the law of sizes begins; without a value: by the fit
};

}  // namespace talus::analysis
