#pragma once
/// The inner loops of the accelerated solver, in single precision, compiled for the baseline processor and
/// again for AVX2, and chosen at run time. Both do the same operations on eight lanes in the same order, so
/// they give the same bits. Only plain data here: an inline function of the library compiled for AVX2 could
/// end up in the baseline program.

#include <cstddef>
#include <cstdint>

#include "core/types.h"

namespace talus {

/// Four floats, as wide as a vector register of the baseline: velocity or mobility of a body, or impulse of a
/// contact in the axes of the bed. The spin of a body is r omega, which makes disks of any size alike; its
/// mobility is negative, as P_t slows both bodies down.
struct alignas(16) Row {
  float x, spin, y, unused;
};

/// Contacts are worked on eight at a time.
inline constexpr int lane_count = 8;
using Lane = float[lane_count];

/// Where in its group of eight a contact stands: neighbours in halves of the register, four lanes apart.
constexpr int lane_of(std::size_t contact) {
  return static_cast<int>(contact % lane_count / 2 + (contact % 2) * (lane_count / 2));
}

/// Eight contacts around the impulses P0 at which the problem was linearised, in the units of the solve. The
/// increment p = P - P0 is what the iterations look for: in single precision, it can be found to any digit.
struct alignas(64) ContactGroup {
  Lane nx, ny;
  Lane un, ut;        ///< relative velocity at P0
  Lane pn;            ///< P0_n: the increment may not fall below -P0_n
  Lane above, below;  ///< mu P0_n - P0_t and mu P0_n + P0_t: what is left until the contact slides
  Lane mu;
  Lane wn, wt;                                 ///< inverse of the Delassus diagonal
  std::uint32_t a[lane_count], b[lane_count];  ///< where the rows of the two bodies begin, bytes
};

/// Increments of eight contacts.
struct alignas(64) ImpulseGroup {
  Lane n, t;
};

/// Impulses of eight contacts in the axes of the bed, in the order of the contacts.
struct alignas(64) ForceGroup {
  Row rows[lane_count];
};

/// Contacts are shared out in blocks of this many groups; the sums of a block do not depend on who computes
/// it.
inline constexpr Index groups_per_block = 64;
inline constexpr Index contacts_per_block = groups_per_block * lane_count;

/// Sums over contacts at the extrapolated point y.
struct IterationSums {
  double change = 0.0;  ///< || p_new - y ||^2
  double ascent = 0.0;  ///< (y - p_new) . (p_new - p): > 0 where the momentum points uphill
};

struct ContactArrays {
  const ContactGroup* contacts;
  ImpulseGroup* increment;  ///< in: p of the last iteration; out: the new p
  ImpulseGroup* ahead;      ///< in: y; out: the next y = p_new + beta (p_new - p)
  const Row* velocity;      ///< of the bodies, due to y
  ForceGroup* force;        ///< out: the next y in the axes of the bed
};

struct BodyArrays {
  const Row* mobility;
  const ForceGroup* force;
  /// Body i is the first body of contacts first_a[i] ... first_a[i + 1] - 1, and the second body of those
  /// listed in entries first_b[i] ... first_b[i + 1] - 1 of b_force, as the bytes where their rows begin.
  const Index *first_a, *first_b;
  const std::uint32_t* b_force;
  Row* velocity;
};

/// One projected gradient step (T16), in units of the inverse diagonal, for groups first ... last - 1.
using ContactKernel = void (*)(const ContactArrays& arrays, Index first, Index last, float step, float beta,
                               IterationSums& sums);
/// Velocities of bodies first ... last - 1 due to the forces of their contacts.
using BodyKernel = void (*)(const BodyArrays& arrays, Index first, Index last);

struct GradientKernels {
  ContactKernel contacts;
  BodyKernel bodies;
};

/// The fastest kernels that this processor has.
GradientKernels gradient_kernels();

GradientKernels gradient_kernels_baseline();
GradientKernels gradient_kernels_avx2();

}  // namespace talus
