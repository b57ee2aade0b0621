#pragma once
/// Guards against unsound runs: grains that are too fast, growing overlaps and energies, and steps that stay
/// unsolved. (A step whose velocities are not finite ends before the world is changed: dynamics/step.h.)

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "dynamics/step.h"
#include "scenario/scenario.h"

namespace talus::session {

enum class Guard : std::size_t { velocity, overlap, energy, unconverged, count };
inline constexpr std::size_t guard_count = static_cast<std::size_t>(Guard::count);
inline constexpr std::array<std::string_view, guard_count> guard_names = {"velocity", "overlap", "energy",
                                                                          "unconverged"};

/// Values that the guards check, in the units of their limits.
using GuardValues = std::array<double, guard_count>;

/// Returns the values after a step; `unconverged`: number of consecutive steps that have missed their
/// tolerance.
GuardValues guard_values(const World& world, const dynamics::StepReport& report, std::int64_t unconverged,
                         const scenario::Scenario& scenario);
GuardValues guard_limits(const scenario::Scenario& scenario);

/// Returns "step 812: a grain moves at 1.2e+04 sqrt(g D); guards.velocity allows 1000".
std::string guard_message(Guard guard, double value, double limit, std::int64_t step);

/// Steps in which guards were exceeded, while guards.action is "warn".
struct GuardWarnings {
  std::array<std::int64_t, guard_count> steps{};  ///< number of steps
  std::array<std::int64_t, guard_count> first{};  ///< first step
};

}  // namespace talus::session
