#include "runs/analysis_parameters.h"

#include <fmt/core.h>

#include "scenario/settings.h"
#include "scenario/text.h"

namespace talus::runs {
namespace {

using P = analysis::AnalysisParameters;

scenario::NumberRange from_zero_to(double high) { return {0.0, high, true, {}}; }
scenario::NumberRange above_zero_or(double high, std::string word) {
  return {0.0, high, false, std::move(word)};
}

}  // namespace

const std::vector<AnalysisKey>& analysis_keys() {
  static const std::vector<AnalysisKey> keys = {
      {{"threshold_factors", "Gamma_c", scenario::NumberList{4, 10.0},
        "thresholds from which on a grain counts as overloaded; all that depends on one is computed for "
        "each"},
       &P::threshold_factors},
      {{"gamma_c", "", above_zero_or(1.0, "run"),
        "Gamma_c, the threshold of the packing; run: sin(theta_c), where the slope has failed"},
       &P::gamma_c},
      {{"l_min", "D", from_zero_to(100.0),
        "diameter of the neighbourhood whose stress ratio is the gamma of a grain, and at which the search "
        "for l_c begins; 3: a grain and its first neighbours; 0: the grain alone"},
       &P::l_min},
      {{"lc_factor", "Gamma_c", above_zero_or(10.0, "threshold"),
        "stress ratio of a neighbourhood at which the search for l_c ends; threshold: that from which on a "
        "grain counts as overloaded"},
       &P::lc_factor},
      {{"lc_cut", "D", above_zero_or(1e4, "depth"),
        "diameter at which the search for l_c ends; depth: min(H, L/2)"},
       &P::lc_cut},
      {{"joining", "", scenario::Choices{{"contacts", "neighbours"}},
        "what joins two overloaded grains: a contact with force, or centres closer than 1.1 times the sum of "
        "the radii"},
       &P::joining},
      {{"averaging", "deg", from_zero_to(10.0),
        "tilt over which the internal moment of a grain is averaged, half of it on either side of the frame; "
        "0: that of the frame alone"},
       &P::averaging},
      {{"min_contacts", "", scenario::IntegerRange{1, 6},
        "force-carrying contacts that a grain must have to count: a grain with fewer has no gamma, as one "
        "that carries nothing"},
       &P::min_contacts},
      {{"sections", "", scenario::IntegerRange{1, 1000}, "equal sections along the bed, for sigma_xx over x"},
       &P::sections},
      {{"bins", "", scenario::IntegerRange{1, 1000}, "bins of each distribution and correlation"}, &P::bins},
      {{"event_velocity", "g h", above_zero_or(1e6, "solver"),
        "rms velocity of the free grains from which on a bed rearranges; solver: what the solver leaves at "
        "its tolerance, times 10"},
       &P::event_velocity},
      {{"event_quiet", "sqrt(D/g)", from_zero_to(1000.0),
        "time for which a bed must stay below event_velocity for a rearrangement to be over"},
       &P::event_quiet},
      {{"event_displacement", "D", from_zero_to(100.0),
        "displacement from which on a grain has moved in an event"},
       &P::event_displacement},
      {{"event_size_min", "m g D", above_zero_or(1e12, "fit"),
        "energy from which on sizes are fitted by a power law; fit: that which it agrees with best"},
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
