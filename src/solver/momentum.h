#pragma once
/// Nesterov's momentum over Gauss-Seidel sweeps (T16).

#include <algorithm>
#include <cmath>

namespace talus::solver {

/// Decides after each sweep how far the next one extrapolates. Restarts are those of O'Donoghue and Candes
/// (2015), and one more: sliding makes the problem non-associated, so that the residual can grow along the
/// momentum; and where closed contacts ask for velocities that no motion has, forces drift along a
/// self-stress, with momentum ever faster. Where the change of a sweep is by so much above its least since
/// the momentum began, it begins anew.
struct Momentum {
  static constexpr double tolerated_growth = 1.2;
  static constexpr double theta_begun_anew = 0.25;

  double theta = 1.0;
  double beta = 0.0;          ///< y = P + beta (P - P of the sweep before)
  double least_change = 0.0;  ///< of a sweep since the momentum began; 0: none yet

  /// `change` is that of a sweep, || P_new - y ||, and `ascent` (y - P_new) . (P_new - P): positive where the
  /// momentum points uphill.
  void update(double change, double ascent) {
    least_change = least_change > 0.0 ? std::min(least_change, change) : change;
    if (ascent > 0.0 || change > tolerated_growth * least_change) {
      theta = theta_begun_anew;
      beta = 0.0;
      least_change = change;
      return;
    }
    grow();
  }

  /// What a sweep does to the momentum that goes on.
  void grow() {
    const double square = theta * theta;
    const double next = 0.5 * (std::sqrt(square * square + 4.0 * square) - square);
    beta = theta * (1.0 - theta) / (square + next);
    theta = next;
  }
};

}  // namespace talus::solver
