#pragma once
/// What a user can choose about an analysis, and the table of its keys: `--set key=value` of `talus analyze`
/// and docs/analysis.md go by it.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analysis/coarse_graining.h"
#include "core/snapshot.h"

namespace talus {

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
};

struct AnalysisKey {
  std::string name;
  std::string unit;   ///< empty where there is none
  std::string range;  ///< "a number in (0, 1]"
  std::string help;
  std::function<std::string(const AnalysisParameters&)> get;
  /// Takes a value; false, with nothing changed, where it is not in the range.
  std::function<bool(AnalysisParameters&, const std::string&)> set;
};

const std::vector<AnalysisKey>& analysis_keys();

/// The parameters with "key=value" settings on the defaults. Throws LocatedError(bad_data) with a line for
/// each setting that is not accepted.
AnalysisParameters parse_analysis_settings(const std::vector<std::string>& settings);

/// Names and values of all parameters, in the order of their table.
Facts as_facts(const AnalysisParameters& parameters);
/// The parameters of such a list, as an analysis has it. Throws as parse_analysis_settings does.
AnalysisParameters from_facts(const Facts& facts);

}  // namespace talus
