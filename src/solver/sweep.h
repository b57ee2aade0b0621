#pragma once
/// Sweeps over the contacts by a team: one after another, or several in a wave.

#include <span>
#include <vector>

#include "base/thread_team.h"
#include "solver/linearisation.h"
#include "solver/momentum.h"

namespace talus::solver {

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
