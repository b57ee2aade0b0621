#pragma once
/// Quantities that a run records of its world, and guards against unsound runs.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/snapshot.h"
#include "dynamics/step.h"
#include "scenario/scenario.h"

namespace talus::session {

using scenario::Scenario;

// Guards against unsound runs: grains that are too fast, growing overlaps and energies, and steps that stay
// unsolved. (A step whose velocities are not finite ends before the world is changed: dynamics/step.h.)

inline constexpr std::size_t guard_count = 4;
inline constexpr std::array<std::string_view, guard_count> guard_names = {"velocity", "overlap", "energy",
                                                                          "unconverged"};

/// Values that the guards check, in the units of their limits.
using GuardValues = std::array<double, guard_count>;

/// Returns the values after a step; `unconverged`: consecutive steps that have missed their tolerance.
GuardValues guard_values(const World& world, const dynamics::StepReport& report, std::int64_t unconverged,
                         const Scenario& scenario);
GuardValues guard_limits(const Scenario& scenario);

/// Returns "step 812: a grain moves at 1.2e+04 sqrt(g D); guards.velocity allows 1000" for guard k.
std::string guard_message(std::size_t k, double value, double limit, std::int64_t step);

/// Steps in which guards were exceeded, while guards.action is "warn".
struct GuardWarnings {
  std::array<std::int64_t, guard_count> steps{};  ///< number of steps
  std::array<std::int64_t, guard_count> first{};  ///< first step
};

/// Reference of strains: the bed at rest before the tilt.
struct Baseline {
  double volume = 0.0;                 ///< V0, m^2
  double centre_of_mass_height = 0.0;  ///< y0, m
};
/// Returns the baseline of a bed, which is 0 without free grains.
Baseline measure_baseline(const World& world);

/// Inputs of a row of observables in addition to the world.
struct RowContext {
  Baseline baseline;
  dynamics::ContactLawParameters law;
  double surface_displacement = 0.0;  ///< m
  double largest_overlap = 0.0;       ///< m, of the last step
  double residual = 0.0;              ///< largest eta since the last row, that of the last step included
  bool at_rest = false;
};
/// Returns a row of the observables (core/observables.h), in SI units and per metre of thickness. Compression
/// is positive, and so is a shear stress due to gravity towards +x.
ObservableRow measure(const World& world, const RowContext& context);

/// Returns a row of the series of steps.
StepRow step_row(const World& world, const dynamics::StepReport& report, double phase);

/// Returns a frame: a copy of the state with grain stresses and the contacts that carry force.
Frame make_frame(const World& world, const dynamics::ContactLawParameters& law);

}  // namespace talus::session
