#pragma once
/// The inner loops of the accelerated solver, compiled for the baseline processor and again for AVX2, and
/// chosen at run time. Both do the same operations on four lanes in the same order, so they give the same
/// bits. Only plain data here: an inline function of the library compiled for AVX2 could end up in the
/// baseline program.

#include "core/types.h"

namespace talus {

/// One row of four doubles, as wide as a vector register: (x, y, spin, unused) of a body or of a contact.
struct alignas(32) Quad {
  double x, y, spin, unused;
};

/// Contacts are worked on four at a time.
inline constexpr int lane_count = 4;

/// Contacts are worked on in blocks of this many; the sums of a block do not depend on who computes it.
inline constexpr Index contacts_per_block = 512;

/// Sums over contacts at the extrapolated point y.
struct PassSums {
  double change = 0.0;         ///< || P' - y ||^2 of the natural map
  double impulse = 0.0;        ///< || y ||^2
  double impulse_after = 0.0;  ///< || P' ||^2
  double ascent = 0.0;         ///< (y - P_new) . D (P_new - P): > 0 where the momentum points uphill
};

/// What the passes work on. The spin of a body is r omega, which makes disks of any size alike:
/// U_t = (v_b - v_a) . t - (s_a + s_b) + c_t.
struct GradientArrays {
  // Bodies.
  const Quad* free;      ///< velocity at zero impulse, m/s
  const Quad* mobility;  ///< (1/m, 1/m, r^2/I, 0), 1/kg
  Quad* now;             ///< velocity at P
  Quad* ahead;           ///< velocity at y
  const Index* first_a;  ///< contacts first_a[i] ... first_a[i + 1] - 1 have body i as their a
  const Index* first_b;  ///< entries first_b[i] ... of b_contact have it as their b
  const Index* b_contact;
  // Contacts.
  const double *nx, *ny, *cn, *ct;
  const double *wn, *wt;  ///< inverse of the Delassus diagonal, kg
  const double* mu;
  const Index *a, *b;
  double *pn, *pt;                ///< P
  double *pn_before, *pt_before;  ///< in: P of the pass before; out: the new P
  Quad* force;                    ///< the new P in the bed's axes: (f_x, f_y, P_t, 0)
  double beta;                    ///< y = P + beta (P - P_before)
  double step;                    ///< of the gradient, in units of the inverse diagonal
};

/// One projected gradient step for contacts first ... last - 1 (multiples of the lane count).
using ContactPass = void (*)(const GradientArrays& arrays, Index first, Index last, PassSums& sums);
/// Velocities of bodies first ... last - 1 at the new impulses, and extrapolated by `beta`.
using BodyPass = void (*)(const GradientArrays& arrays, Index first, Index last, double beta);

struct GradientKernels {
  ContactPass contacts;
  BodyPass bodies;
};

/// The fastest kernels that this processor has.
GradientKernels gradient_kernels();

GradientKernels gradient_kernels_baseline();
GradientKernels gradient_kernels_avx2();

}  // namespace talus
