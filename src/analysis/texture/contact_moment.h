#pragma once
/// Contribution of a contact to the internal moments of the free grains.

#include "analysis/free_grains.h"

namespace talus::analysis {

/// Adds the contribution of contact c to the sum of the internal moments of the free grains, branch vector
/// times force (T19), J per metre of thickness.
inline void add_moment(const BedFrame& bed, Index c, Tensor2& sum) {
  const FrameContacts& contacts = bed.frame.contacts;
  const Vector2 n{contacts.nx[c], contacts.ny[c]}, t{-contacts.ny[c], contacts.nx[c]};
  const Vector2 f = contacts.fn[c] * n + contacts.ft[c] * t;
  matrix(sum) += branch_length(bed, c) * n * f.transpose();
}

}  // namespace talus::analysis
