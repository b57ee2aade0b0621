#pragma once
/// Helpers for the analysis of a frame. Free grains have the ids 0 ... free_count - 1.

#include <vector>

#include "core/snapshot.h"
#include "core/tensor.h"

namespace talus::analysis {

/// Returns the entries of the free grains from an array over all grains.
inline std::vector<double> free_grain_values(const std::vector<double>& values, const RunStatics& statics) {
  return {values.begin(), values.begin() + statics.free_count};
}

/// Period along x, m; 0 if the bed is not periodic.
inline double period_of(const RunStatics& statics) { return statics.periodic ? statics.length : 0.0; }

/// Calls visit(id) for each free grain at contact c.
template <typename Visit>
void for_each_free_end(const BedFrame& bed, Index c, const Visit& visit) {
  if (bed.frame.contacts.a[c] < bed.statics.free_count) visit(bed.frame.contacts.a[c]);
  if (bed.frame.contacts.b[c] < bed.statics.free_count) visit(bed.frame.contacts.b[c]);
}

/// Returns the length of the branch vector at contact c that enters the internal moments of the free grains,
/// m: the sum of the radii of the free grains at the contact.
inline double branch_length(const BedFrame& bed, Index c) {
  double length = 0.0;
  for_each_free_end(bed, c, [&](Index i) { length += bed.statics.radius[i]; });
  return length;
}

/// Adds a tensor to a sum.
inline void add_to(Tensor2& sum, const Tensor2& term) { matrix(sum) += matrix(term); }

}  // namespace talus::analysis
