#pragma once
/// Sweeps of a team over the contacts: one after another, or several in a wave.

#include <span>
#include <vector>

#include "base/thread_team.h"
#include "solver/linearisation.h"
#include "solver/momentum.h"

namespace talus::solver {

/// So many sweeps may follow each other before the momentum is looked at.
inline constexpr int most_sweeps_in_a_row = 4;

/// So many sums there are of each part of a sweep: of the sweeps that follow each other, in two turns. While
/// one member still reads those of a turn, another may be at work on the next, but not on the one after that.
inline constexpr int sums_of_part = 2 * most_sweeps_in_a_row;

/// What one member of a team needs to sweep. All members call the functions below together.
struct Sweeper {
  Linearisation& at;
  /// Of part k in sweep s of turn t: entry (t * most_sweeps_in_a_row + s) * part_count + k.
  std::vector<SweepSums>& sums;
  ThreadTeam* team;  ///< null: alone
  int member, size;
  SweepKernels kernels;
  int turn = 0;  ///< the same for all members
};

/// How many sweeps follow each other: several in a bed so large that its contacts do not stay in the caches.
/// Follows from the order alone.
int sweeps_in_a_row(const SweepOrder& order);

/// Whether a wave of so many sweeps has room to begin in a place for each member of a team of this size.
bool fits_wave(const SweepOrder& order, int sweeps, int size);

/// Sweeps with beta[s] as the momentum of sweep s (T16), phase by phase.
void sweep_by_phases(const Sweeper& sweeper, std::span<const float> beta);

/// The same sweeps, to the bit, where domains form a ring: several of them run through the bed as a wave, so
/// that what is read of a domain serves all of them. Only where fits_wave().
void sweep_in_wave(const Sweeper& sweeper, std::span<const float> beta);

/// The next `count` sweeps, at most most_sweeps_in_a_row, in the faster way, each with the momentum that it
/// has if none before it makes it begin anew. Then `momentum` is told what they changed. Returns || p_new - y
/// || of the last one. The next sweeps have the other turn.
double sweep(Sweeper& sweeper, int count, Momentum& momentum);

}  // namespace talus::solver
