#pragma once
/// Sweeps over the contacts by a team: one after another, or several in a wave.

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "base/thread_team.h"
#include "solver/linearisation.h"

namespace talus::solver {

// Nesterov's momentum over Gauss-Seidel sweeps (T16).

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

/// Largest number of sweeps in succession before the momentum is updated.
inline constexpr int max_sweeps_in_a_row = 4;

/// Number of sums of each part of a sweep: one for each sweep in succession, in two turns. While one member
/// still reads the sums of a turn, another may already work on the next turn, but not on the one after it.
inline constexpr int sums_of_part = 2 * max_sweeps_in_a_row;

/// State of one member of a team during sweeps. All members call the functions below together.
struct Sweeper {
  Linearisation& at;
  /// Sums of the parts; entry (t * max_sweeps_in_a_row + s) * part_count + k is part k in sweep s of turn t.
  std::vector<SweepSums>& sums;
  ThreadTeam* team;  ///< null: single thread
  int member, size;
  SweepKernels kernels;
  int turn = 0;  ///< present turn, 0 or 1, the same for all members
};

/// Returns the number of sweeps in succession: several if the bed is so large that its contacts do not stay
/// in the caches. Follows from the order alone.
int sweeps_in_a_row(const SweepOrder& order);

/// Whether a wave of `sweeps` sweeps can start at one place for each member of a team of this size.
bool fits_wave(const SweepOrder& order, int sweeps, int size);

/// Sweeps phase by phase, with beta[s] as the momentum of sweep s (T16).
void sweep_by_phases(const Sweeper& sweeper, std::span<const float> beta);

/// Makes the same sweeps, bit for bit, if the domains form a ring: the sweeps run through the bed as a wave,
/// so that one read of a domain from memory serves all of them. Requires fits_wave().
void sweep_in_wave(const Sweeper& sweeper, std::span<const float> beta);

/// Makes `count` sweeps, at most max_sweeps_in_a_row, in a wave if that fits, each with the momentum that it
/// has if no sweep before it causes a restart. Then updates `momentum` with their changes. Returns
/// || p_new - y || of the last sweep. The next call uses the other turn.
double sweep(Sweeper& sweeper, int count, Momentum& momentum);

}  // namespace talus::solver
