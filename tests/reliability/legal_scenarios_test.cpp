/// Random scenarios that the table of keys allows. Each ends in time, in a run or in a documented error, and
/// `talus check` accepts each run while it computes and when it is done. The long version uses TALUS_TRIES
/// scenarios: .ci/full legal.

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <thread>

#include "reliability/legal_scenario.h"
#include "session/estimate.h"
#include "support/process.h"

namespace talus::test {
namespace {

using Clock = std::chrono::steady_clock;

int number_from(const char* variable, int usual) {
  const char* asked = std::getenv(variable);
  return asked != nullptr ? std::atoi(asked) : usual;
}

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// Returns whether docs/errors.md documents this end of a run.
bool is_documented(int code, const std::string& said) {
  if (code == 0) return true;
  const auto says = [&said](const char* words) { return said.find(words) != std::string::npos; };
  return code == 65 && (says("did not come to rest within deposition.max_time") || says("; guards.") ||
                        says("error: key '") || says("bed.csv"));
}

class LegalScenarios : public testing::Test {
 protected:
  Outcome check() { return run_talus({"check", "run.h5", "--json"}, folder.path()); }

  /// Runs a scenario to its end, or until it has taken far longer than estimated; checks it meanwhile.
  int run(const std::string& name, double seconds) {
    const pid_t process = start_talus({"run", name, "-o", "run.h5", "-q", "--threads", "1"}, folder.path());
    const auto begin = Clock::now();
    for (double pause = 0.005; !has_ended(process); pause *= 1.5) {
      std::this_thread::sleep_for(std::chrono::duration<double>(pause));
      if (seconds_since(begin) > seconds) {
        kill(process, SIGTERM);
        ++late;
        return wait_for(process);
      }
      if (!std::filesystem::exists(folder.path("run.h5.run/manifest"))) continue;
      const Outcome live = check_run();
      EXPECT_TRUE(live.exit_code == 0 || live.exit_code == 66) << live.out << live.err;
      checked_live += live.exit_code == 0 ? 1 : 0;
    }
    return wait_for(process);
  }

  /// Runs `check` in another folder, because the run's folder holds its messages.
  Outcome check_run() { return run_talus({"check", folder.path("run.h5")}, aside.path()); }

  TemporaryFolder folder, aside;
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
    const std::string said = errors_in(folder.path());
    ++codes[code];
    if (code != 75 && !is_documented(code, said)) {  // 75: it took long and was stopped
      const std::string kept = "legal-" + std::to_string(k) + ".toml";
      std::filesystem::copy_file(folder.path("legal.toml"), std::filesystem::temp_directory_path() / kept,
                                 std::filesystem::copy_options::overwrite_existing);
      ADD_FAILURE() << "scenario " << k << ", kept as " << kept << ", estimated " << expected
                    << " s: " << code << ": " << said;
    }
    if (std::filesystem::exists(folder.path("run.h5")) ||
        std::filesystem::exists(folder.path("run.h5.run/manifest"))) {
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
