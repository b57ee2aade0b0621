#pragma once
/// Parameters of an analysis that a user can choose.

#include <optional>
#include <vector>

#include "analysis/overload/coarse_graining.h"

namespace talus::analysis {

/// The condition under which two overloaded grains belong to one cluster.
enum class Joining {
  contacts,    ///< a contact that carries force
  neighbours,  ///< centres closer than 1.1 times the sum of the radii
};

/// Parameters of an analysis with their defaults (docs/analysis.md).
struct AnalysisParameters {
  std::vector<double> threshold_factors = {1.0, 2.0};  ///< thresholds in units of Gamma_c, ascending
  std::optional<double> gamma_c;                       ///< default: sin(theta_c) of the run
  double l_min = default_l_min;     ///< smallest diameter of a neighbourhood, in D; 0: the single grain
  std::optional<double> lc_factor;  ///< end ratio of l_c in units of Gamma_c; default: threshold_factors
  std::optional<double> lc_cut;     ///< largest l_c, in D; default: min(H, L/2)
  Joining joining = Joining::contacts;
  double averaging = 0.0;  ///< range of tilt over which internal moments are averaged, deg; 0: a single frame
  int min_contacts = 1;    ///< force-carrying contacts that a grain needs to be counted
  int sections = 20;
  int bins = 50;
  /// Rms velocity from which the bed rearranges, in g h; default: from the solver tolerance.
  std::optional<double> event_velocity;
  double event_quiet = 1.0;              ///< quiet time after which an event is over, in sqrt(D/g)
  double event_displacement = 0.01;      ///< displacement from which a grain counts as moved, in D
  std::optional<double> event_size_min;  ///< lower end of the power law of sizes, in m g D; default: fitted

  bool operator==(const AnalysisParameters&) const = default;
};

}  // namespace talus::analysis
