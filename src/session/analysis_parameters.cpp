#include "session/analysis_parameters.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/errors.h"
#include "core/text_stream.h"
#include "session/scenario_text.h"

namespace talus {
namespace {

constexpr std::size_t most_factors = 4;

std::optional<double> parse_number(const std::string& text, double above, double highest) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc() && end == text.data() + text.size();
  return whole && value > above && value <= highest ? std::optional(value) : std::nullopt;
}

/// "1,2" as ascending numbers; nothing where it is something else.
std::optional<std::vector<double>> parse_factors(const std::string& text) {
  std::vector<double> factors;
  std::istringstream words = text_stream(text + ",");
  for (std::string word; std::getline(words, word, ',');) {
    const auto factor = parse_number(word, 0.0, 10.0);
    if (!factor || (!factors.empty() && *factor <= factors.back())) return std::nullopt;
    factors.push_back(*factor);
  }
  return factors.size() <= most_factors ? std::optional(factors) : std::nullopt;
}

AnalysisKey optional_number(const std::string& name, const std::string& unit, const std::string& word,
                            double highest, const std::string& help,
                            std::optional<double> AnalysisParameters::*field) {
  return {name,
          unit,
          std::string("a number in (0, ") + short_text(highest) + "], or " + word,
          help,
          [=](const AnalysisParameters& p) { return p.*field ? short_text(*(p.*field)) : word; },
          [=](AnalysisParameters& p, const std::string& text) {
            const auto value = parse_number(text, 0.0, highest);
            if (value || text == word) p.*field = value;
            return value || text == word;
          }};
}

AnalysisKey number_from_zero(const std::string& name, const std::string& unit, double highest,
                             const std::string& help, double AnalysisParameters::*field) {
  return {name,
          unit,
          std::string("a number in [0, ") + short_text(highest) + "]",
          help,
          [=](const AnalysisParameters& p) { return short_text(p.*field); },
          [=](AnalysisParameters& p, const std::string& text) {
            const auto value = parse_number(text, -1.0, highest);
            if (!value || *value < 0.0) return false;
            p.*field = *value;
            return true;
          }};
}

AnalysisKey count(const std::string& name, int highest, const std::string& help,
                  int AnalysisParameters::*field) {
  return {name,
          "",
          std::string("an integer in 1 ... ") + std::to_string(highest),
          help,
          [=](const AnalysisParameters& p) { return std::to_string(p.*field); },
          [=](AnalysisParameters& p, const std::string& text) {
            const auto value = parse_number(text, 0.0, highest);
            if (!value || *value != std::floor(*value)) return false;
            p.*field = static_cast<int>(*value);
            return true;
          }};
}

AnalysisKey factors_key() {
  return {
      "threshold_factors",
      "Gamma_c",
      "1 ... 4 ascending numbers in (0, 10], with commas between",
      "thresholds from which on a grain counts as overloaded; all that depends on one is computed for each",
      [](const AnalysisParameters& p) {
        std::string text;
        for (const double factor : p.threshold_factors)
          text.append(text.empty() ? "" : ",").append(short_text(factor));
        return text;
      },
      [](AnalysisParameters& p, const std::string& text) {
        const auto factors = parse_factors(text);
        if (factors) p.threshold_factors = *factors;
        return factors.has_value();
      }};
}

AnalysisKey joining_key() {
  return {
      "joining",
      "",
      "contacts or neighbours",
      "what joins two overloaded grains: a contact with force, or centres closer than 1.1 times the sum of "
      "the radii",
      [](const AnalysisParameters& p) {
        return std::string(p.joining == Joining::contacts ? "contacts" : "neighbours");
      },
      [](AnalysisParameters& p, const std::string& text) {
        if (text != "contacts" && text != "neighbours") return false;
        p.joining = text == "contacts" ? Joining::contacts : Joining::neighbours;
        return true;
      }};
}

const AnalysisKey* find_analysis_key(const std::string& name) {
  const auto key = std::ranges::find(analysis_keys(), name, &AnalysisKey::name);
  return key == analysis_keys().end() ? nullptr : &*key;
}

/// What is wrong with a setting; empty where it was taken.
std::string take(AnalysisParameters& parameters, const std::string& setting) {
  const auto equals = setting.find('=');
  if (equals == std::string::npos) return "expected key=value, such as --set lc_cut=30";
  const std::string name = setting.substr(0, equals), value = setting.substr(equals + 1);
  const AnalysisKey* key = find_analysis_key(name);
  if (key == nullptr) {
    std::string names;
    for (const AnalysisKey& known : analysis_keys()) names += (names.empty() ? "" : ", ") + known.name;
    return "unknown key '" + printable(name) + "'; expected one of " + names;
  }
  if (key->set(parameters, value)) return "";
  return "key '" + name + "' = " + printable(value) + ": expected " + key->range +
         (key->unit.empty() ? "" : ", in " + key->unit);
}

}  // namespace

const std::vector<AnalysisKey>& analysis_keys() {
  using P = AnalysisParameters;
  static const std::vector<AnalysisKey> keys = {
      factors_key(),
      optional_number("gamma_c", "", "run", 1.0,
                      "Gamma_c, the threshold of the packing; run: sin(theta_c), where the slope has failed",
                      &P::gamma_c),
      number_from_zero(
          "l_min", "D", 100.0,
          "diameter of the neighbourhood whose stress ratio is the gamma of a grain, and at which the search "
          "for l_c begins; 3: a grain and its first neighbours; 0: the grain alone",
          &P::l_min),
      optional_number(
          "lc_factor", "Gamma_c", "threshold", 10.0,
          "stress ratio of a neighbourhood at which the search for l_c ends; threshold: that from "
          "which on a grain counts as overloaded",
          &P::lc_factor),
      optional_number("lc_cut", "D", "depth", 1e4,
                      "diameter at which the search for l_c ends; depth: min(H, L/2)", &P::lc_cut),
      joining_key(),
      number_from_zero(
          "averaging", "deg", 10.0,
          "tilt over which the internal moment of a grain is averaged, half of it on either side "
          "of the frame; 0: that of the frame alone",
          &P::averaging),
      count(
          "min_contacts", 6,
          "force-carrying contacts that a grain must have to count: a grain with fewer has no gamma, as one "
          "that carries nothing",
          &P::min_contacts),
      count("sections", 1000, "equal sections along the bed, for sigma_xx over x", &P::sections),
      count("bins", 1000, "bins of each distribution and correlation", &P::bins),
  };
  return keys;
}

AnalysisParameters parse_analysis_settings(const std::vector<std::string>& settings) {
  AnalysisParameters parameters;
  std::string complaints;
  for (const std::string& setting : settings)
    if (const std::string complaint = take(parameters, setting); !complaint.empty())
      complaints.append(complaints.empty() ? "" : "\n")
          .append("--set ")
          .append(printable(setting))
          .append(": error: ")
          .append(complaint);
  if (!complaints.empty()) throw LocatedError(ExitCode::bad_data, complaints);
  return parameters;
}

Facts as_facts(const AnalysisParameters& parameters) {
  Facts facts;
  for (const AnalysisKey& key : analysis_keys()) facts.emplace_back(key.name, key.get(parameters));
  return facts;
}

AnalysisParameters from_facts(const Facts& facts) {
  std::vector<std::string> settings;
  for (const auto& [name, value] : facts) settings.push_back(name + "=" + value);
  return parse_analysis_settings(settings);
}

}  // namespace talus
