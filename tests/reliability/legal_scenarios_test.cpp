/// Random scenarios that the table of keys allows. Each ends in time, in a run or in a documented error, and
/// `talus check` accepts each run while it computes and when it is done. The long version uses TALUS_TRIES
/// scenarios: .ci/full legal.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fmt/core.h>
#include <iterator>
#include <map>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "core/random.h"
#include "scenario/keys.h"
#include "scenario/scenario.h"
#include "session/estimate.h"
#include "support/commands.h"

namespace talus::test {
namespace {

int number_from(const char* variable, int usual) {
  const char* asked = std::getenv(variable);
  return asked != nullptr ? std::atoi(asked) : usual;
}

/// Returns whether docs/errors.md documents this end of a run.
bool is_documented(int code, const std::string& said) {
  if (code == 0) return true;
  const auto says = [&said](const char* words) { return has(said, words); };
  return code == 65 && (says("did not come to rest within deposition.max_time") || says("; guards.") ||
                        says("error: key '") || says("bed.csv"));
}

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

/// Returns a scenario of a bed of 10 to 20 D by 1 to 10 D, tilted fast, with random values of some keys
/// within their ranges, preferably at the ends. It breaks no rule of scenario/keys.h, and its estimate is at
/// most `seconds`. `beds` are bed files that deposition.file may name.
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

class LegalScenarios : public testing::Test {
 protected:
  /// Runs a scenario to its end, or until it has taken far longer than estimated; checks it meanwhile.
  int run(const std::string& name, double seconds) {
    const pid_t process = folder.start({"run", name, "-o", "run.h5", "-q", "--threads", "1"});
    const auto begin = Clock::now();
    for (double pause = 0.005; !has_ended(process); pause *= 1.5) {
      std::this_thread::sleep_for(std::chrono::duration<double>(pause));
      if (seconds_since(begin) > seconds) {
        kill(process, SIGTERM);
        ++late;
        return wait_for(process);
      }
      if (!folder.has_file("run.h5.run/manifest")) continue;
      const Outcome live = check_run();
      EXPECT_TRUE(live.exit_code == 0 || live.exit_code == 66) << live.out << live.err;
      checked_live += live.exit_code == 0 ? 1 : 0;
    }
    return wait_for(process);
  }

  /// Runs `check` in another folder, because the run's folder holds its messages.
  Outcome check_run() { return aside.talus({"check", folder.path("run.h5")}); }

  CommandFolder folder, aside;
  int checked_live = 0, checked = 0, late = 0;
};

TEST_F(LegalScenarios, end_in_a_sound_run_or_in_a_documented_refusal) {
  const int count = number_from("TALUS_TRIES", 12);
  Random random(static_cast<std::uint64_t>(number_from("TALUS_SEED", 1)));
  write_file(folder, "bed.csv", "1 0.6 0.5\n2.5 0.6 0.5\n4 0.6 0.5\n");
  std::map<int, int> codes;
  double slowest = 0.0;
  for (int k = 0; k < count; ++k) {
    const scenario::Scenario scenario = legal_scenario(random, 1.0, {folder.path("bed.csv")});
    const double expected = session::estimate(scenario).seconds;
    write_file(folder, "legal.toml", scenario::resolved_toml(scenario));
    const auto begin = Clock::now();
    const int code = run("legal.toml", 5.0 + 20.0 * expected);
    slowest = std::max(slowest, seconds_since(begin) / (1.0 + expected));
    const std::string said = folder.errors();
    ++codes[code];
    if (code != 75 && !is_documented(code, said)) {  // 75: it took long and was stopped
      const std::string kept = "legal-" + std::to_string(k) + ".toml";
      std::filesystem::copy_file(folder.path("legal.toml"), std::filesystem::temp_directory_path() / kept,
                                 std::filesystem::copy_options::overwrite_existing);
      ADD_FAILURE() << "scenario " << k << ", kept as " << kept << ", estimated " << expected
                    << " s: " << code << ": " << said;
    }
    if (folder.has_file("run.h5") || folder.has_file("run.h5.run/manifest")) {
      const Outcome outcome = check_run();
      ++checked;
      EXPECT_EQ(outcome.exit_code, 0)
          << "scenario " << k << ": " << outcome.out << outcome.err << scenario::resolved_toml(scenario);
    }
    std::filesystem::remove_all(folder.path("run.h5.run"));
    std::filesystem::remove(folder.path("run.h5"));
  }
  std::printf(
      "%d scenarios, %d of them stopped after 5 s and 20 times their estimate; %d checks of a run that "
      "computes, "
      "%d of one that has ended; slowest %.1f times\n",
      count, late, checked_live, checked, slowest);
  for (const auto& [code, times] : codes) std::printf("  exit code %d: %d\n", code, times);
}

}  // namespace
}  // namespace talus::test
