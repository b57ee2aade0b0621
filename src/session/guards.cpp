#include "session/guards.h"

#include <cmath>
#include <fmt/core.h>

#include "scenario/text.h"

namespace talus::session {

GuardValues guard_values(const World& world, const dynamics::StepReport& report, std::int64_t unconverged,
                         const scenario::Scenario& scenario) {
  const Motion& motion = report.motion;
  const double diameter = scenario.grains.mean_diameter;
  GuardValues values{};
  values[static_cast<std::size_t>(Guard::velocity)] =
      motion.largest_velocity / std::sqrt(world.gravity * diameter);
  values[static_cast<std::size_t>(Guard::overlap)] = report.largest_overlap / diameter;
  values[static_cast<std::size_t>(Guard::energy)] =
      motion.kinetic_energy / (motion.mass * world.gravity * scenario.bed.depth * diameter);
  values[static_cast<std::size_t>(Guard::unconverged)] = static_cast<double>(unconverged);
  return values;
}

GuardValues guard_limits(const scenario::Scenario& scenario) {
  const scenario::Scenario::Guards& guards = scenario.guards;
  return {guards.velocity, guards.overlap, guards.energy, static_cast<double>(guards.unconverged)};
}

std::string guard_message(Guard guard, double value, double limit, std::int64_t step) {
  const auto said = [guard](const std::string& number) -> std::string {
    switch (guard) {
      case Guard::velocity:
        return fmt::format("a grain moves at {} sqrt(g D)", number);
      case Guard::overlap:
        return fmt::format("two grains overlap by {} D", number);
      case Guard::energy:
        return fmt::format("the mean kinetic energy of a grain is {} m g H", number);
      case Guard::unconverged:
      case Guard::count:
        break;
    }
    return number + " consecutive steps did not reach their tolerance";
  };
  return fmt::format("step {}: {}; guards.{} allows {}", step, said(scenario::short_text(value)),
                     guard_names[static_cast<std::size_t>(guard)], scenario::short_text(limit));
}

}  // namespace talus::session
