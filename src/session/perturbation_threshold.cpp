#include "session/perturbation_threshold.h"

#include <cmath>

namespace talus::session {

Threshold threshold_of(std::span<const Trial> trials) {
  Threshold found;
  for (const Trial& trial : trials) {
    const double strength = trial.strength;
    if (strength == 0.0) {
      found.held = trial.end == TrialEnd::rest;
      if (!found.held) found.with = 0.0;
    } else if (trial.end == TrialEnd::avalanche) {
      if (strength <= found.without)
        found.monotone = false;
      else if (strength < found.with)
        found.with = strength;
    } else if (trial.end == TrialEnd::rest) {
      if (strength >= found.with)
        found.monotone = false;
      else if (strength > found.without)
        found.without = strength;
    }
  }
  return found;
}

std::vector<Trial> search_threshold(const std::function<Trial(double strength)>& trial_at) {
  std::vector<Trial> trials;
  const auto ends_with = [&](double strength, TrialEnd end) {
    trials.push_back(trial_at(strength));
    return trials.back().end == end;
  };
  if (!ends_with(strongest_push, TrialEnd::avalanche)) return trials;
  if (!ends_with(weakest_push, TrialEnd::rest)) return trials;
  for (int k = 0; k < threshold_bisections; ++k) {
    const Threshold found = threshold_of(trials);
    if (ends_with(std::sqrt(found.without * found.with), TrialEnd::undecided)) break;
  }
  const Threshold found = threshold_of(trials);
  trials.push_back(trial_at(found.without / threshold_check));
  if (found.with * threshold_check <= strongest_push)
    trials.push_back(trial_at(found.with * threshold_check));
  return trials;
}

std::vector<Trial> perturb(World world, const scenario::Scenario& scenario, const SurfacePatch& patch,
                           const std::function<void()>& should_continue) {
  std::vector<Trial> trials = {follow(world, scenario, should_continue)};
  if (trials.front().end != TrialEnd::rest) return trials;
  const std::vector<Trial> pushes = search_threshold(
      [&](double strength) { return push_trial(world, scenario, patch, strength, should_continue); });
  trials.insert(trials.end(), pushes.begin(), pushes.end());
  return trials;
}

}  // namespace talus::session
