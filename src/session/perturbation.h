#pragma once
/// Perturbations of a bed at a fixed tilt: a push on a part of its surface, and what becomes of it.
/// Free functions on worlds; strengths are dimensionless, so that beds of any grain size compare.

#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "core/world.h"
#include "scenario/scenario.h"

namespace talus::session {

/// A part of the free surface. Lengths in mean diameters D.
struct SurfacePatch {
  double width = 10.0;  ///< along the bed
  double depth = 2.0;   ///< below the free surface, its mean over the patch

  bool operator==(const SurfacePatch&) const = default;
};

/// The free grains whose centres lie in the patch whose middle is at `centre` (m), ascending; across the edge
/// of a periodic bed.
std::vector<Index> grains_in_patch(const World& world, const SurfacePatch& patch, double centre,
                                   double mean_diameter);

/// Adds a velocity downslope, along the bed, to the grains. Returns the kinetic energy that this gives, J per
/// metre.
double push(Grains& grains, std::span<const Index> pushed, double velocity);

/// How a trial ended. Rest: the bed is at rest as a deposition ends (rest_steps in a row slower than
/// deposition.rest_velocity). Avalanche: the slope failed, by the rule that defines theta_c (flow_rule).
/// Undecided: neither within trial_time.
enum class TrialEnd { rest, avalanche, undecided };
std::string_view name_of(TrialEnd end);

/// A trial is given up after this time, in sqrt(D / g).
inline constexpr double trial_time = 200.0;

/// What became of a bed that was left to itself at its tilt.
struct Trial {
  double strength = 0.0;  ///< velocity of the push over sqrt(g D); 0: no push
  double energy = 0.0;    ///< kinetic energy given, over m g D, m the mass of a disk of diameter D
  TrialEnd end = TrialEnd::undecided;
  double time = 0.0;          ///< until then, in sqrt(D / g)
  Index moved = 0;            ///< free grains whose centres then were more than D from where they had been
  double displacement = 0.0;  ///< D, mean of the surface layer downslope
};

/// Steps a world at its tilt, as a run of the scenario does, until it is at rest or has failed. `keep_on` is
/// asked before each step, and throws where the trial is to be given up; it may be empty.
Trial follow(World& world, const scenario::Scenario& scenario, const std::function<void()>& keep_on = {});

/// A push of `strength` on the patch in the middle of a copy of the bed, and what became of it.
Trial push_trial(World world, const scenario::Scenario& scenario, const SurfacePatch& patch, double strength,
                 const std::function<void()>& keep_on = {});

}  // namespace talus::session
