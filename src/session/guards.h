#pragma once
/// What no sound run does, and how it is told: grains that are too fast, overlaps and energies that grow,
/// steps that stay unsolved. (A velocity that is not finite ends a step before the world is changed:
/// dynamics/step.h.)

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

/// What the guards watch: in the units of their limits.
using GuardValues = std::array<double, guard_count>;

/// After a step; `unconverged` steps in a row have missed their tolerance by then.
GuardValues guard_values(const World& world, const dynamics::StepReport& report, std::int64_t unconverged,
                         const scenario::Scenario& scenario);
GuardValues guard_limits(const scenario::Scenario& scenario);

/// "step 812: a grain moves at 1.2e+04 sqrt(g D); guards.velocity allows 1000".
std::string guard_message(Guard guard, double value, double limit, std::int64_t step);

/// The steps in which a guard was broken, while guards.action is "warn".
struct GuardWarnings {
  std::array<std::int64_t, guard_count> steps{};  ///< how many
  std::array<std::int64_t, guard_count> first{};  ///< the first of them
};

}  // namespace talus::session
