#pragma once
/// Perturbations of a bed at a fixed tilt: a push on a part of its surface, and the response.
/// Free functions on worlds; strengths are dimensionless, so that beds of any grain size can be compared.

#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "core/world.h"
#include "scenario/scenario.h"

namespace talus::session {

/// Part of the free surface. Lengths in mean diameters D.
struct SurfacePatch {
  double width = 10.0;  ///< along the bed
  double depth = 2.0;   ///< below the mean free surface over the patch

  bool operator==(const SurfacePatch&) const = default;
};

/// Returns the free grains with centres in the patch around `centre` (m), ascending; the patch may cross the
/// edge of a periodic bed.
std::vector<Index> grains_in_patch(const World& world, const SurfacePatch& patch, double centre,
                                   double mean_diameter);

/// Adds a downslope velocity, along the bed, to the grains. Returns the kinetic energy added, J per metre.
double push(Grains& grains, std::span<const Index> pushed, double velocity);

/// Outcome of a trial. Rest: the bed is at rest by the criterion of a deposition (rest_steps consecutive
/// steps slower than deposition.rest_velocity). Avalanche: the slope failed, by the rule that defines theta_c
/// (flow_rule). Undecided: neither within trial_time.
enum class TrialEnd { rest, avalanche, undecided };
std::string_view name_of(TrialEnd end);

/// Maximum duration of a trial, sqrt(D / g).
inline constexpr double trial_time = 200.0;

/// Response of a bed at fixed tilt.
struct Trial {
  double strength = 0.0;  ///< velocity of the push over sqrt(g D); 0: no push
  double energy = 0.0;    ///< kinetic energy of the push over m g D, m the mass of a disk of diameter D
  TrialEnd end = TrialEnd::undecided;
  double time = 0.0;          ///< duration, sqrt(D / g)
  Index moved = 0;            ///< free grains displaced by more than D at the end
  double displacement = 0.0;  ///< D, mean downslope displacement of the surface layer
};

/// Steps a world at its tilt, as a run of the scenario does, until it is at rest or has failed.
/// `should_continue` is called before each step, and throws to abandon the trial; it may be empty.
Trial follow(World& world, const scenario::Scenario& scenario,
             const std::function<void()>& should_continue = {});

/// Applies a push of `strength` to the patch in the middle of a copy of the bed, and returns the response.
Trial push_trial(World world, const scenario::Scenario& scenario, const SurfacePatch& patch, double strength,
                 const std::function<void()>& should_continue = {});

}  // namespace talus::session
