#include "solver/team_choice.h"

#include <algorithm>

namespace talus::solver {
namespace {

constexpr double window = 0.02;  // s, several slices of the scheduler
// Windows between two trials: few if the last trial paid, and doubled after each trial that did not.
constexpr int min_trial_interval = 8;
constexpr int max_trial_interval = 256;
// Length (s) of a trial that seems to pay, because a team may have all processors for one window by chance.
constexpr double trial = 4.0 * window;
// Weight of a window in the usual cost. It is small because a single window may be slow by chance, and a
// trial would then seem to pay.
constexpr double share_of_window = 0.25;

}  // namespace

void TeamChoice::add(double seconds, double work) {
  seconds_ += seconds;
  work_ += work;
  if (seconds_ < window || work_ <= 0.0) return;
  const double cost = seconds_ / work_;
  if (on_trial_ && cost < usual_cost_ && seconds_ < trial) return;
  decide(cost);
  seconds_ = work_ = 0.0;
}

void TeamChoice::decide(double cost) {
  if (!in_team_) min_alone_ = min_alone_ == 0.0 ? cost : std::min(min_alone_, cost);
  if (on_trial_) {
    on_trial_ = false;
    windows_since_trial_ = 0;
    const bool pays = cost < usual_cost_;
    if (pays) usual_cost_ = cost;
    trial_interval_ =
        pays ? min_trial_interval : std::clamp(2 * trial_interval_, min_trial_interval, max_trial_interval);
    if (!pays) turn();
    return;
  }
  usual_cost_ = usual_cost_ == 0.0 ? cost : (1.0 - share_of_window) * usual_cost_ + share_of_window * cost;
  // A team faster than the fastest window of a single thread needs no trial.
  if (++windows_since_trial_ <= trial_interval_ || (in_team_ && min_alone_ > 0.0 && cost < min_alone_))
    return;
  on_trial_ = true;
  turn();
}

}  // namespace talus::solver
