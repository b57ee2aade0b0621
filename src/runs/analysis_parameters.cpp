#include "runs/analysis_parameters.h"

#include <fmt/core.h>

#include "scenario/text.h"

namespace talus::runs {
namespace {

using P = analysis::AnalysisParameters;
using scenario::above_to, scenario::from_to;

}  // namespace

const std::vector<AnalysisKey>& analysis_keys() {
  static const std::vector<AnalysisKey> keys = {
      {{"threshold_factors", "Gamma_c", scenario::NumberList{4, 10.0},
        "thresholds at or above which a grain counts as overloaded; everything that depends on a threshold "
        "is computed for each"},
       &P::threshold_factors},
      {{"gamma_c", "", above_to(0.0, 1.0, "run"),
        "Gamma_c, the threshold of the packing; run: sin(theta_c), if the slope has failed"},
       &P::gamma_c},
      {{"l_min", "D", from_to(0.0, 100.0),
        "diameter of the neighbourhood whose stress ratio is the gamma of a grain, and at which the search "
        "for l_c begins; 3: a grain and its first neighbours; 0: the single grain"},
       &P::l_min},
      {{"lc_factor", "Gamma_c", above_to(0.0, 10.0, "threshold"),
        "stress ratio of a neighbourhood at which the search for l_c ends; threshold: that of the "
        "overloaded grains"},
       &P::lc_factor},
      {{"lc_cut", "D", above_to(0.0, 1e4, "depth"),
        "diameter at which the search for l_c ends; depth: min(H, L/2)"},
       &P::lc_cut},
      {{"joining", "", scenario::Choices{{"contacts", "neighbours"}},
        "condition that joins two overloaded grains: a contact with force, or centres closer than 1.1 times "
        "the sum of the radii"},
       &P::joining},
      {{"averaging", "deg", from_to(0.0, 10.0),
        "tilt over which the internal moment of a grain is averaged, half of it on either side of the frame; "
        "0: no averaging"},
       &P::averaging},
      {{"min_contacts", "", scenario::IntegerRange{1, 6},
        "force-carrying contacts that a grain must have to count: a grain with fewer has no gamma, like one "
        "that carries nothing"},
       &P::min_contacts},
      {{"sections", "", scenario::IntegerRange{1, 1000}, "equal sections along the bed, for sigma_xx over x"},
       &P::sections},
      {{"bins", "", scenario::IntegerRange{1, 1000}, "bins of each distribution and correlation"}, &P::bins},
      {{"event_velocity", "g h", above_to(0.0, 1e6, "solver"),
        "rms velocity of the free grains at or above which a bed counts as rearranging; solver: 10 times "
        "the velocity error of the solver at its tolerance"},
       &P::event_velocity},
      {{"event_quiet", "sqrt(D/g)", from_to(0.0, 1000.0),
        "time for which a bed must stay below event_velocity for a rearrangement to be over"},
       &P::event_quiet},
      {{"event_displacement", "D", from_to(0.0, 100.0),
        "displacement at or above which a grain counts as moved in an event"},
       &P::event_displacement},
      {{"event_size_min", "m g D", above_to(0.0, 1e12, "fit"),
        "smallest energy in the power-law fit of sizes; fit: the value with the best agreement"},
       &P::event_size_min},
  };
  return keys;
}

analysis::AnalysisParameters parse_analysis_settings(const std::vector<std::string>& settings) {
  return scenario::parse_settings(analysis_keys(), settings, "lc_cut=30");
}

Facts as_facts(const analysis::AnalysisParameters& parameters) {
  Facts facts;
  for (const AnalysisKey& key : analysis_keys())
    facts.emplace_back(key.name, scenario::plain_text(key.get(parameters)));
  return facts;
}

analysis::AnalysisParameters from_facts(const Facts& facts) {
  std::vector<std::string> settings;
  for (const auto& [name, value] : facts) settings.push_back(fmt::format("{}={}", name, value));
  return parse_analysis_settings(settings);
}

}  // namespace talus::runs
