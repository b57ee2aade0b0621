#pragma once
/// Nesterov's momentum over Gauss-Seidel sweeps (T16).

#include <algorithm>
#include <cmath>

namespace talus::solver {

/// Decides after each sweep how far the next one extrapolates. The momentum restarts by the criterion of
/// O'Donoghue and Candes (2015), and if the change of a sweep exceeds its minimum since the last restart by
/// the factor `tolerated_growth`. The second criterion is needed for two reasons: sliding makes the problem
/// non-associated, so that the residual can grow along the momentum; and if closed contacts demand velocities
/// that no motion has, forces drift along a self-stress, and momentum accelerates the drift.
struct Momentum {
  static constexpr double tolerated_growth = 1.2;
  static constexpr double theta_after_restart = 0.25;

  double theta = 1.0;
  double beta = 0.0;        ///< extrapolation: y = P + beta (P - P of the previous sweep)
  double min_change = 0.0;  ///< smallest change of a sweep since the last restart; 0: no sweep yet

  /// Updates theta and beta after a sweep. `change` is || P_new - y ||; `ascent` is
  /// (y - P_new) . (P_new - P), which is positive if the momentum points uphill.
  void update(double change, double ascent) {
    min_change = min_change > 0.0 ? std::min(min_change, change) : change;
    if (ascent > 0.0 || change > tolerated_growth * min_change) {
      theta = theta_after_restart;
      beta = 0.0;
      min_change = change;
      return;
    }
    grow();
  }

  /// Advances theta and beta by one sweep without a restart.
  void grow() {
    const double square = theta * theta;
    const double next = 0.5 * (std::sqrt(square * square + 4.0 * square) - square);
    beta = theta * (1.0 - theta) / (square + next);
    theta = next;
  }
};

}  // namespace talus::solver
