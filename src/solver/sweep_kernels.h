#pragma once
/// The inner loops of the accelerated solver, in single precision, compiled for the baseline processor and
/// again for AVX2, and chosen at run time. Both do the same operations on eight lanes in the same order, so
/// they give the same bits. Only plain data here: an inline function of the library compiled for AVX2 could
/// end up in the baseline program.

#include <cstddef>
#include <cstdint>

#include "core/types.h"

namespace talus::solver {

/// Four floats, as wide as a vector register of the baseline: velocity of a body. Its spin is r omega, which
/// makes disks of any size alike; where contacts resist rolling, its turn is omega times a length that is
/// the same for all, else 0.
struct alignas(16) Row {
  float x, spin, y, turn;
};

/// Contacts are worked on eight at a time.
inline constexpr int lane_count = 8;
using Lane = float[lane_count];

/// Eight contacts, no two of which share a body that moves, around the impulses P0 at which the problem was
/// linearised, in the units of the solve. The increment p = P - P0 is what the sweeps look for: in single
/// precision, it can be found to any digit. A lane without a contact is all zero, between rows that do not
/// move. A sweep is as fast as this is small: what is the same for all contacts is not here.
struct alignas(32) ContactGroup {
  Lane nx, ny;
  Lane un, ut;          ///< relative velocity at P0
  Lane least;           ///< -P0_n: the least normal increment
  Lane below, above;    ///< -mu P0_n - P0_t and mu P0_n - P0_t: the contact slides there, but for mu p_n
  Lane wn, wt;          ///< inverse of the Delassus diagonal, times the relaxation
  Lane mass_a, mass_b;  ///< what a unit impulse in the axes of the bed adds to x and y; mass_a is negative
  std::uint32_t a[lane_count], b[lane_count];  ///< where the rows of the two bodies begin, bytes
};

/// What eight contacts have beside these fields where contacts are not alike: not all have the same friction,
/// or not all bodies are disks, I = m r^2 / 2, of which P_t adds twice as much to r omega as to the velocity.
struct alignas(32) UnlikeGroup {
  Lane mu;
  Lane spin_a,
      spin_b;  ///< what a unit of P_t adds to the spin; negative; not read where contacts resist rolling
};

/// What eight contacts that resist rolling have beside the fields above, in the units of the solve; lengths
/// over that of the turn.
struct alignas(64) RollingGroup {
  Lane ur;            ///< relative velocity l (omega_b - omega_a) at P0
  Lane below, above;  ///< -mu_r P0_n - P0_r and mu_r P0_n - P0_r
  Lane mu;            ///< mu_r
  Lane w;             ///< inverse of W_rr, times the relaxation
  Lane coupling;      ///< W_rt: what a unit P_t adds to u_r
  Lane length, lever_a, lever_b;
  Lane inertia_a, inertia_b;  ///< mobilities: what a unit moment impulse adds to the turn of a body
};

/// So many groups are swept side by side: none of their contacts share a body that moves. A processor cannot
/// tell soon enough that what it reads for a group is not what it is about to write for the one before, so
/// that groups one by one would wait for each other.
inline constexpr int groups_abreast = 2;

/// Impulses of eight contacts.
struct alignas(64) ImpulseGroup {
  Lane n, t;
};

/// Their rolling impulses.
struct alignas(32) RollingImpulses {
  Lane r;
};

/// Sums over contacts at the extrapolated point y.
struct SweepSums {
  double change = 0.0;  ///< || p_new - y ||^2
  double ascent = 0.0;  ///< (y - p_new) . (p_new - p): > 0 where the momentum points uphill
};

struct ContactArrays {
  const ContactGroup* contacts;
  ImpulseGroup* increment;  ///< in: p of the last sweep; out: the new p
  ImpulseGroup* last_move;  ///< in: what the last sweep added to p; out: what this one has added
  Row* velocity;            ///< of the bodies; in: due to y = p + momentum * last_move; out: due to the new p
  float mu;                 ///< of contacts that are alike
  const UnlikeGroup* unlike = nullptr;  ///< null where they are
  /// Whether to ask memory for groups before their turn: pays where they do not stay in the caches.
  bool reads_ahead = false;
  // Where contacts resist rolling; else null.
  const RollingGroup* rolling = nullptr;
  RollingImpulses* rolling_increment = nullptr;
  RollingImpulses* rolling_move = nullptr;
};

/// Velocity of a body, or impulse of a contact in the axes of the bed, in double precision; the spin is r
/// omega. Where contacts resist rolling, the turn is omega of a body, and l P_r of a contact; else 0.
struct alignas(32) ExactRow {
  double x = 0.0, y = 0.0, spin = 0.0, turn = 0.0;
};

/// Fields of contacts in the order of the problem.
struct LookArrays {
  const Index *a, *b;
  const double *nx, *ny, *cn, *ct, *mu;
  const double *pn, *pt;  ///< P0
  const double *wn, *wt;  ///< inverse of the Delassus diagonal
  const ExactRow* velocity;
  double *un, *ut;  ///< out: relative velocities
  // Where contacts resist rolling; else null.
  const double *length = nullptr, *mu_r = nullptr;
  const double *pr = nullptr, *wr = nullptr;  ///< P0, and 1 / W_rr
  double* ur = nullptr;                       ///< out
};

/// The sums of ResidualSums (residual.h).
struct LookSums {
  double change = 0.0, impulse = 0.0, impulse_after = 0.0, largest = 0.0;
};

struct BodyArrays {
  Row* velocity;  ///< in: due to p; out: due to y
  Row* before;    ///< in: due to p before the last sweep; out: due to p
};

/// A sweep with momentum (T16) over groups first ... last - 1, one after another: each contact is solved with
/// the velocities that the ones before it leave.
using ContactKernel = void (*)(const ContactArrays& arrays, Index first, Index last, float momentum,
                               SweepSums& sums);
/// Velocities of bodies first ... last - 1 at the extrapolated point.
using BodyKernel = void (*)(const BodyArrays& arrays, Index first, Index last, float momentum);

/// Relative velocities of contacts first ... last - 1 at P0, and what solving each of them exactly would
/// change (T13, T14).
using LookKernel = void (*)(const LookArrays& arrays, std::size_t first, std::size_t last, LookSums& sums);

/// Bodies have a few contacts each: in steps of several, the number of steps is nearly always the same, and
/// predictable.
inline constexpr int sides_at_once = 4;

/// What the velocities of bodies are summed from.
struct BodySumArrays {
  const Index* first_side;  ///< the contacts of body i are first_side[i] ... first_side[i + 1] - 1 of sides
  const std::uint32_t* sides;  ///< 2 c of the second body of contact c, 2 c + 1 of the first
  const ExactRow* force;       ///< impulses of the contacts
  const double *vx, *vy, *omega, *inverse_mass, *inverse_inertia, *lever;
  ExactRow* velocity;  ///< out
};
/// v = v_free + M^-1 H P (T6) of bodies first ... last - 1.
using BodySumKernel = void (*)(const BodySumArrays& arrays, Index first, Index last);

struct SweepKernels {
  ContactKernel contacts;
  BodyKernel bodies;
  LookKernel look;
  BodySumKernel body_sums;
  // Of contacts that resist rolling.
  ContactKernel rolling_contacts;
  LookKernel rolling_look;
  BodySumKernel rolling_body_sums;
};

/// The fastest kernels that this processor has.
SweepKernels sweep_kernels();

SweepKernels sweep_kernels_baseline();
SweepKernels sweep_kernels_avx2();

}  // namespace talus::solver
