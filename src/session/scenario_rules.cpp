#include "session/scenario_rules.h"

#include "session/scenario_text.h"

namespace talus {
namespace {

constexpr double shortest_time_step = 1e-5;  // s
constexpr double longest_time_step = 1e-2;   // s
constexpr double most_grains = 2e6;

}  // namespace

std::vector<BrokenRule> broken_rules(const Scenario& scenario) {
  std::vector<BrokenRule> broken;
  const double h = time_step(scenario);
  // 0.001 / 100 is not 1e-5 to the last bit: what is written as the end of the range belongs to it.
  constexpr double round_off = 1e-12;
  if (h < shortest_time_step * (1.0 - round_off) || h > longest_time_step * (1.0 + round_off))
    broken.push_back({{"tilt.step", "tilt.rate"},
                      "a time step h = tilt.step / tilt.rate in [" + short_text(shortest_time_step) + ", " +
                          short_text(longest_time_step) + "] s; it is " + short_text(h) + " s"});
  const double grains = scenario.bed.length * scenario.bed.depth;
  const bool from_file = scenario.deposition.method == DepositionMethod::file;
  if (grains > most_grains && !from_file)
    broken.push_back({{"bed.length", "bed.depth"},
                      "at most " + short_text(most_grains) + " grains, bed.length * bed.depth; they are " +
                          short_text(grains)});
  if (from_file && scenario.deposition.file.empty())
    broken.push_back({{"deposition.method", "deposition.file"},
                      "with it deposition.file, the path of a run or of a table; it is not given"});
  if (!from_file && !scenario.deposition.file.empty())
    broken.push_back(
        {{"deposition.file", "deposition.method"}, "deposition.method = \"file\" with it, or no file"});
  if (scenario.tilt.end_angle && *scenario.tilt.end_angle < scenario.tilt.step)
    broken.push_back({{"tilt.end_angle", "tilt.step"},
                      "tilt.end_angle >= tilt.step; they are " + short_text(*scenario.tilt.end_angle) +
                          " and " + short_text(scenario.tilt.step) + " deg"});
  if (scenario.solver.moving_tolerance < scenario.solver.tolerance)
    broken.push_back({{"solver.moving_tolerance", "solver.tolerance"},
                      "solver.moving_tolerance >= solver.tolerance; they are " +
                          short_text(scenario.solver.moving_tolerance) + " and " +
                          short_text(scenario.solver.tolerance)});
  const auto at_least_a_step = [&](const std::string& key, double every) {
    if (every < scenario.tilt.step)
      broken.push_back({{key, "tilt.step"},
                        key + " >= tilt.step; they are " + short_text(every) + " and " +
                            short_text(scenario.tilt.step) + " deg"});
  };
  at_least_a_step("output.frame_every", scenario.output.frame_every);
  at_least_a_step("output.observable_every", scenario.output.observable_every);
  return broken;
}

}  // namespace talus
