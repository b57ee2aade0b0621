#include "solver/team_choice.h"

#include <algorithm>

namespace talus {
namespace {

constexpr double window = 0.02;  // s, several slices of the scheduler
// Windows from a trial to the next: few, as long as trials change something, and twice as many each time that
// they do not.
constexpr int least_patience = 8;
constexpr int most_patience = 64;

}  // namespace

void TeamChoice::add(double seconds, double work) {
  seconds_ += seconds;
  work_ += work;
  if (seconds_ < window || work_ <= 0.0) return;
  decide(seconds_ / work_);
  seconds_ = work_ = 0.0;
}

void TeamChoice::decide(double cost) {
  if (!in_team_) least_alone_ = least_alone_ == 0.0 ? cost : std::min(least_alone_, cost);
  if (on_trial_) {
    on_trial_ = false;
    settled_ = 0;
    const bool pays = cost < cost_before_trial_;
    patience_ = pays ? least_patience : std::clamp(2 * patience_, least_patience, most_patience);
    if (!pays) turn();
    return;
  }
  // A team that is faster than one thread has ever been needs no trial.
  if (++settled_ <= patience_ || (in_team_ && least_alone_ > 0.0 && cost < least_alone_)) return;
  cost_before_trial_ = cost;
  on_trial_ = true;
  turn();
}

}  // namespace talus
