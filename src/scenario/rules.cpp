#include "scenario/rules.h"

#include <cmath>
#include <fmt/core.h>

#include "scenario/text.h"
#include "scenario/tilt_program.h"

namespace talus::scenario {
namespace {

constexpr double shortest_time_step = 1e-5;  // s
constexpr double longest_time_step = 1e-2;   // s
constexpr double longest_over_fall = 0.4;    // sqrt(D / g)

}  // namespace

std::vector<BrokenRule> broken_rules(const Scenario& scenario) {
  std::vector<BrokenRule> broken;
  const double h = time_step(scenario);
  const double fall = std::sqrt(scenario.grains.mean_diameter / gravity);
  // A product such as 0.001 / 100 may differ from 1e-5 by rounding, and the ends of the range are included.
  constexpr double round_off = 1e-12;
  if (h < shortest_time_step * (1.0 - round_off) || h > longest_time_step * (1.0 + round_off))
    broken.push_back(
        {{"tilt.step", "tilt.rate"},
         fmt::format("a time step h = tilt.step / tilt.rate in [{}, {}] s; it is {} s",
                     short_text(shortest_time_step), short_text(longest_time_step), short_text(h))});
  else if (h > longest_over_fall * fall * (1.0 + round_off))
    broken.push_back({{"grains.mean_diameter", "tilt.step", "tilt.rate"},
                      fmt::format("a time step h = tilt.step / tilt.rate of at most {} sqrt(D / g), or "
                                  "grains would fall past each other; it is {} sqrt(D / g)",
                                  short_text(longest_over_fall), short_text(h / fall))});
  const double grains = scenario.bed.length * scenario.bed.depth;
  const bool from_file = scenario.deposition.method == DepositionMethod::file;
  if (grains > max_grains && !from_file)
    broken.push_back({{"bed.length", "bed.depth"},
                      fmt::format("at most {} grains, bed.length * bed.depth; they are {}",
                                  short_text(max_grains), short_text(grains))});
  if (from_file && scenario.deposition.file.empty())
    broken.push_back({{"deposition.method", "deposition.file"},
                      "deposition.file, the path of a run or of a table, with it; it is not given"});
  if (!from_file && !scenario.deposition.file.empty())
    broken.push_back(
        {{"deposition.file", "deposition.method"}, "deposition.method = \"file\" with it, or no file"});
  if (scenario.tilt.end_angle && *scenario.tilt.end_angle < scenario.tilt.step)
    broken.push_back({{"tilt.end_angle", "tilt.step"},
                      fmt::format("tilt.end_angle >= tilt.step; they are {} and {} deg",
                                  short_text(*scenario.tilt.end_angle), short_text(scenario.tilt.step))});
  // Steps can only be counted with a valid time step.
  if (broken.empty())
    if (std::string fault = program_fault(scenario); !fault.empty())
      broken.push_back({{"tilt.program", "tilt.end_angle"}, std::move(fault)});
  if (scenario.solver.moving_tolerance < scenario.solver.tolerance)
    broken.push_back(
        {{"solver.moving_tolerance", "solver.tolerance"},
         fmt::format("solver.moving_tolerance >= solver.tolerance; they are {} and {}",
                     short_text(scenario.solver.moving_tolerance), short_text(scenario.solver.tolerance))});
  const auto at_least_a_step = [&](const std::string& key, double every) {
    if (every < scenario.tilt.step)
      broken.push_back({{key, "tilt.step"},
                        fmt::format("{} >= tilt.step; they are {} and {} deg", key, short_text(every),
                                    short_text(scenario.tilt.step))});
  };
  at_least_a_step("output.frame_every", scenario.output.frame_every);
  at_least_a_step("output.observable_every", scenario.output.observable_every);
  return broken;
}

}  // namespace talus::scenario
