#pragma once
/// What a contact adds to the internal moments of the free grains.

#include "analysis/free_grains.h"

namespace talus::analysis {

/// Adds the part of contact c in the sum of the internal moments of the free grains (T19), J: branch vector
/// times force.
inline void add_moment(const BedFrame& bed, Index c, Tensor2& sum) {
  const FrameContacts& contacts = bed.frame.contacts;
  const Vector2 n{contacts.nx[c], contacts.ny[c]}, t{-contacts.ny[c], contacts.nx[c]};
  const Vector2 f = contacts.fn[c] * n + contacts.ft[c] * t;
  matrix(sum) += branch_length(bed, c) * n * f.transpose();
}

}  // namespace talus::analysis
