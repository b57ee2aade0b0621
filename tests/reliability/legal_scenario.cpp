#include "reliability/legal_scenario.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fmt/core.h>
#include <limits>
#include <variant>

#include "scenario/keys.h"
#include "scenario/rules.h"
#include "session/estimate.h"

namespace talus::test {
namespace {

std::uint32_t whole(std::size_t count) { return static_cast<std::uint32_t>(count); }

/// Returns one of three with equal probability: the lower end or its neighbour, the upper end, or a value
/// between, chosen by its logarithm if the range spans decades.
double number_in(const scenario::NumberRange& range, Random& random) {
  const double low = range.low_included ? range.low : std::max(1e-300, 1e-9 * std::min(range.high, 1.0));
  const double high = std::isinf(range.high) ? 1e300 : range.high;
  switch (random.below(6)) {
    case 0:
      return low;
    case 1:
      return high;
    case 2:
      return std::nextafter(low, high);
    default:
      break;
  }
  if (low > 0.0 && high / low > 100.0)
    return low * std::pow(10.0, random.uniform(0.0, std::log10(high) - std::log10(low)));
  return random.uniform(low, high);
}

scenario::KeyValue value_in(const scenario::NumberRange& range, Random& random) {
  if (!range.word.empty() && random.below(3) == 0) return range.word;
  return std::clamp(number_in(range, random), range.low, range.high);
}

scenario::KeyValue value_in(const scenario::IntegerRange& range, Random& random) {
  if (random.below(3) == 0) return range.low;
  if (random.below(3) == 0) return range.high;
  const double spread = std::pow(static_cast<double>(range.high - range.low), random.uniform());
  return std::min(range.high, range.low + static_cast<std::int64_t>(spread));
}

scenario::KeyValue value_in(const scenario::Choices& choices, Random& random) {
  return choices.names[random.below(whole(choices.names.size()))];
}

scenario::KeyValue value_in(const scenario::Switch&, Random& random) { return random.below(2) == 0; }
scenario::KeyValue value_in(const scenario::TextRange&, Random&) { return std::string(); }
scenario::KeyValue value_in(const scenario::PhraseList&, Random& random) {
  std::vector<std::string> phrases;
  const std::uint32_t count = 1 + random.below(4);
  for (std::uint32_t k = 0; k < count; ++k) {
    const double angle = random.uniform(-3.0, 3.0);
    phrases.push_back(random.below(3) == 0   ? fmt::format("hold {}", random.uniform(0.001, 0.2))
                      : random.below(2) == 0 ? fmt::format("to {}", angle)
                                             : fmt::format("by {} at {}", angle, random.uniform(1.0, 50.0)));
  }
  if (random.below(2) == 0) phrases.emplace_back("2 times");
  if (random.below(3) == 0) phrases.emplace_back("to repose");
  return phrases;
}
scenario::KeyValue value_in(const scenario::NumberList& list, Random& random) {
  return std::vector{random.uniform() * list.high};
}

scenario::Scenario small_bed(Random& random) {
  scenario::Scenario scenario;
  scenario.seed = random.next();
  scenario.bed.length = 10.0 + random.below(11);
  scenario.bed.depth = random.uniform(1.0, 10.0);
  scenario.deposition.rate = 2.0;
  scenario.tilt.rate = std::pow(10.0, random.uniform(0.5, 1.7));
  scenario.tilt.step = scenario.tilt.rate * std::pow(10.0, random.uniform(-3.0, -2.2));
  scenario.output.frame_every = std::max(scenario.tilt.step, 1.0);
  scenario.output.observable_every = std::max(scenario.tilt.step, 0.1);
  return scenario;
}

/// Returns whether a key determines the size of the bed.
bool is_size(const scenario::ScenarioKey& key) {
  return scenario::full_name(key) == "bed.length" || scenario::full_name(key) == "bed.depth";
}

}  // namespace

scenario::Scenario legal_scenario(Random& random, double seconds, const std::vector<std::string>& beds) {
  for (;;) {
    scenario::Scenario scenario = small_bed(random);
    const std::uint32_t one_in = 2 + random.below(20);
    for (const scenario::ScenarioKey& key : scenario::scenario_keys())
      if (!is_size(key) && random.below(one_in) == 0)
        if (const auto value = scenario::admitted(
                key, std::visit([&](const auto& range) { return value_in(range, random); }, key.range)))
          key.set(scenario, *value);
    scenario.deposition.frame = 0;
    if (scenario.deposition.method == scenario::DepositionMethod::file)
      scenario.deposition.file = beds[random.below(whole(beds.size()))];
    if (!scenario::broken_rules(scenario).empty()) continue;
    if (session::estimate(scenario).seconds <= seconds) return scenario;
  }
}

}  // namespace talus::test
