#pragma once
/// Weakest push that starts an avalanche: a bracket from a bisection, and checks of it.

#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "session/perturbation.h"

namespace talus::session {

/// Range of pushes that a search tries, in sqrt(g D). The strongest push alone displaces the surface layer by
/// less than the 5 D that count as an avalanche; a stronger one would count as an avalanche even if nothing
/// gives way.
inline constexpr double weakest_push = 0.05;
inline constexpr double strongest_push = 5.0;

/// Number of bisections (in the logarithm), after which the ends of a bracket differ by 15 %.
inline constexpr int threshold_bisections = 5;

/// Factor by which two checks lie outside the bracket; the upper one is made only if it does not exceed the
/// strongest push.
inline constexpr double threshold_check = 1.5;

/// Result of the trials of one bed. A push of `without` started no avalanche, a push of `with` did; the
/// response of a bed is erratic, so there may be exceptions on either side.
struct Threshold {
  bool held = true;      ///< the bed comes to rest without a push; otherwise both ends are 0
  double without = 0.0;  ///< sqrt(g D); 0: even the weakest push started an avalanche
  double with =
      std::numeric_limits<double>::infinity();  ///< sqrt(g D); infinite: no push started an avalanche
  bool monotone =
      true;  ///< no push weaker than `without` started an avalanche, and every push stronger than `with` did
};

/// Returns the bracket from trials in sequence. Undecided trials count as neither outcome.
Threshold threshold_of(std::span<const Trial> trials);

/// Makes the trials of a search: strongest, weakest, bisections, checks. It ends early if the strongest push
/// starts no avalanche, if the weakest one does not end at rest, or if a bisection is undecided.
std::vector<Trial> search_threshold(const std::function<Trial(double strength)>& trial_at);

/// Follows a copy of the bed at its tilt without a push, as the first trial; if it comes to rest, searches
/// for the threshold of pushes on the bed at rest. `should_continue` as in follow.
std::vector<Trial> perturb(World world, const scenario::Scenario& scenario, const SurfacePatch& patch,
                           const std::function<void()>& should_continue = {});

}  // namespace talus::session
