#pragma once
/// The weakest push that starts an avalanche: a bracket from a bisection, and checks of it.

#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "session/perturbation.h"

namespace talus::session {

/// Pushes that a search tries, in sqrt(g D). The strongest alone carries the surface layer by less than the
/// 5 D that count as an avalanche; a stronger one would be counted as one where nothing gives way.
inline constexpr double weakest_push = 0.05;
inline constexpr double strongest_push = 5.0;

/// After this many halvings (of the logarithm) the ends of a bracket differ by 15 %.
inline constexpr int threshold_bisections = 5;

/// Two checks lie this factor outside of the bracket, the upper one where that is not above the strongest
/// push.
inline constexpr double threshold_check = 1.5;

/// What the trials of one bed say. A push of `without` started no avalanche, one of `with` did; the response
/// of a bed is erratic, and there may be others on either side.
struct Threshold {
  bool held = true;      ///< the bed comes to rest by itself; else both ends are 0
  double without = 0.0;  ///< sqrt(g D); 0: even the weakest push started one
  double with = std::numeric_limits<double>::infinity();  ///< sqrt(g D); infinite: no push did
  bool monotone = true;  ///< no trial weaker than `without` started one, and each stronger than `with` did
};

/// The bracket that trials narrow down, each in its turn. Trials that are undecided count as neither.
Threshold threshold_of(std::span<const Trial> trials);

/// The trials of a search: strongest, weakest, bisections, checks. It ends early where there is no avalanche,
/// or nothing else, to be had, or where a bisection is undecided.
std::vector<Trial> search_threshold(const std::function<Trial(double strength)>& trial_at);

/// Leaves a copy of the bed to itself at its tilt, the first trial; where it comes to rest, searches for the
/// threshold of pushes on the bed at rest. `keep_on` as in follow.
std::vector<Trial> perturb(World world, const scenario::Scenario& scenario, const SurfacePatch& patch,
                           const std::function<void()>& keep_on = {});

}  // namespace talus::session
