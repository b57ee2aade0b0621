#pragma once
/// The inner loops of the accelerated solver, in single precision. They are compiled for the baseline
/// processor and for AVX2, and chosen at run time. Both versions do the same operations on eight lanes in the
/// same order, so they give the same bits. This header contains plain data only, because an inline function
/// of a library compiled for AVX2 could end up in the baseline program.

#include <cstddef>
#include <cstdint>

#include "core/types.h"

namespace talus::solver {

/// Velocity of a body: four floats, the width of a vector register of the baseline. The spin is r omega,
/// which makes disks of any size alike. If contacts resist rolling, the turn is omega times a length common
/// to all bodies, else 0.
struct alignas(16) Row {
  float x, spin, y, turn;
};

/// Number of contacts processed at a time.
inline constexpr int lane_count = 8;
using Lane = float[lane_count];

/// Eight contacts, no two of which share a body that moves, linearised at the impulses P0, in the units of
/// the solve. The sweeps search for the increment p = P - P0. A lane without a contact is all zero, with rows
/// that do not move. The size of this structure determines the speed of a sweep, so data common to all
/// contacts are elsewhere.
struct alignas(32) ContactGroup {
  Lane nx, ny;
  Lane un, ut;          ///< relative velocity at P0
  Lane least;           ///< -P0_n, the smallest normal increment
  Lane below, above;    ///< -mu P0_n - P0_t and mu P0_n - P0_t, the limits of sliding except for mu p_n
  Lane wn, wt;          ///< inverse of the Delassus diagonal, times the relaxation
  Lane mass_a, mass_b;  ///< change of x and y by a unit impulse in the axes of the bed; mass_a is negative
  std::uint32_t a[lane_count], b[lane_count];  ///< offsets of the rows of the two bodies, bytes
};

/// Additional data of eight contacts if contacts are not alike: friction differs, or not all bodies are disks
/// with I = m r^2 / 2, for which P_t changes r omega by twice as much as the velocity.
struct alignas(32) UnlikeGroup {
  Lane mu;
  Lane spin_a,
      spin_b;  ///< change of the spin by a unit of P_t, negative; not read if contacts resist rolling
};

/// Additional data of eight contacts that resist rolling, in the units of the solve; lengths are relative to
/// that of the turn.
struct alignas(64) RollingGroup {
  Lane ur;            ///< relative velocity l (omega_b - omega_a) at P0
  Lane below, above;  ///< -mu_r P0_n - P0_r and mu_r P0_n - P0_r
  Lane mu;            ///< mu_r
  Lane w;             ///< inverse of W_rr, times the relaxation
  Lane coupling;      ///< W_rt, the change of u_r by a unit of P_t
  Lane length, lever_a, lever_b;
  Lane inertia_a, inertia_b;  ///< mobilities: change of the turn of a body by a unit moment impulse
};

/// Number of interleaved groups; their contacts share no body that moves. Groups swept one by one would wait
/// for each other, because a processor cannot see soon enough that the data read for one group are not those
/// written for the one before.
inline constexpr int groups_abreast = 2;

/// Impulses of eight contacts.
struct alignas(64) ImpulseGroup {
  Lane n, t;
};

/// Rolling impulses of eight contacts.
struct alignas(32) RollingImpulses {
  Lane r;
};

/// Sums over contacts at the extrapolated point y.
struct SweepSums {
  double change = 0.0;  ///< || p_new - y ||^2
  double ascent = 0.0;  ///< (y - p_new) . (p_new - p), positive if the momentum points uphill
};

struct ContactArrays {
  const ContactGroup* contacts;
  ImpulseGroup* increment;  ///< input: p of the last sweep; output: the new p
  ImpulseGroup* last_move;  ///< input: change of p by the last sweep; output: change by this one
  Row* velocity;            ///< bodies; input: due to y = p + momentum * last_move; output: due to the new p
  float mu;                 ///< friction, if contacts are alike
  const UnlikeGroup* unlike = nullptr;  ///< null if contacts are alike
  /// Whether to prefetch groups, which pays if they do not stay in the caches.
  bool reads_ahead = false;
  // Null unless contacts resist rolling.
  const RollingGroup* rolling = nullptr;
  RollingImpulses* rolling_increment = nullptr;
  RollingImpulses* rolling_move = nullptr;
};

/// Velocity of a body, or impulse of a contact in the axes of the bed, in double precision. The spin is
/// r omega. If contacts resist rolling, the turn is omega of a body or l P_r of a contact; else it is 0.
struct alignas(32) ExactRow {
  double x = 0.0, y = 0.0, spin = 0.0, turn = 0.0;
};

/// Fields of contacts in the order of the problem.
struct ResidualArrays {
  const Index *a, *b;
  const double *nx, *ny, *cn, *ct, *mu;
  const double *pn, *pt;  ///< P0
  const double *wn, *wt;  ///< inverse of the Delassus diagonal
  const ExactRow* velocity;
  double *un, *ut;  ///< output: relative velocities
  // Null unless contacts resist rolling.
  const double *length = nullptr, *mu_r = nullptr;
  const double *pr = nullptr, *wr = nullptr;  ///< P0, and 1 / W_rr
  double* ur = nullptr;                       ///< output: rolling velocities
};

/// Sums over contacts, as in ResidualSums (problem.h).
struct ContactResidualSums {
  double change = 0.0, impulse = 0.0, impulse_after = 0.0, largest = 0.0;
};

struct BodyArrays {
  Row* velocity;  ///< input: due to p; output: due to y
  Row* before;    ///< input: due to p before the last sweep; output: due to p
};

/// Sweeps with momentum (T16) over groups first ... last - 1, one after another: each contact is solved with
/// the velocities that result from the contacts before it.
using ContactKernel = void (*)(const ContactArrays& arrays, Index first, Index last, float momentum,
                               SweepSums& sums);
/// Computes the velocities of bodies first ... last - 1 at the extrapolated point.
using BodyKernel = void (*)(const BodyArrays& arrays, Index first, Index last, float momentum);

/// Computes the relative velocities of contacts first ... last - 1 at P0, and the changes that the exact
/// solution of each of them would make (T13, T14).
using ResidualKernel = void (*)(const ResidualArrays& arrays, std::size_t first, std::size_t last,
                                ContactResidualSums& sums);

/// Number of contacts of a body summed at a time. Bodies have a few contacts each, so that the number of
/// such groups is nearly always the same, and branches are predicted well.
inline constexpr int sides_at_once = 4;

/// Arrays from which the velocities of bodies are summed.
struct BodySumArrays {
  const Index* first_side;     ///< contacts of body i: first_side[i] ... first_side[i + 1] - 1 of `sides`
  const std::uint32_t* sides;  ///< 2 c if the body is the second of contact c, 2 c + 1 if it is the first
  const ExactRow* force;       ///< impulses of the contacts
  const double *vx, *vy, *omega, *inverse_mass, *inverse_inertia, *lever;
  ExactRow* velocity;  ///< output
};
/// Computes v = v_free + M^-1 H P (T6) of bodies first ... last - 1.
using BodySumKernel = void (*)(const BodySumArrays& arrays, Index first, Index last);

struct SweepKernels {
  ContactKernel contacts;
  BodyKernel bodies;
  ResidualKernel residual;
  BodySumKernel body_sums;
  // Kernels for contacts that resist rolling.
  ContactKernel rolling_contacts;
  ResidualKernel rolling_residual;
  BodySumKernel rolling_body_sums;
};

/// Returns the fastest kernels that this processor supports.
SweepKernels sweep_kernels();

SweepKernels sweep_kernels_baseline();
SweepKernels sweep_kernels_avx2();

}  // namespace talus::solver
