#pragma once
/// What the analysis of a frame needs of it again and again. Free grains have the ids 0 ... free_count - 1.

#include <vector>

#include "core/bed_frame.h"
#include "core/tensor.h"

namespace talus::analysis {

/// Values of the free grains, of an array over all grains.
inline std::vector<double> of_free_grains(const std::vector<double>& values, const RunStatics& statics) {
  return {values.begin(), values.begin() + statics.free_count};
}

/// Period along x, m; 0 where the bed is not periodic.
inline double period_of(const RunStatics& statics) { return statics.periodic ? statics.length : 0.0; }

/// Calls visit(id) for the free grains at contact c.
template <typename Visit>
void for_each_free_end(const BedFrame& bed, Index c, const Visit& visit) {
  if (bed.frame.contacts.a[c] < bed.statics.free_count) visit(bed.frame.contacts.a[c]);
  if (bed.frame.contacts.b[c] < bed.statics.free_count) visit(bed.frame.contacts.b[c]);
}

/// What the internal moments of the free grains have of the line between centres at contact c, m: from the
/// centre to the contact and on to the other centre, of free grains only.
inline double branch_length(const BedFrame& bed, Index c) {
  double length = 0.0;
  for_each_free_end(bed, c, [&](Index i) { length += bed.statics.radius[i]; });
  return length;
}

inline void add_to(Tensor2& sum, const Tensor2& term) { matrix(sum) += matrix(term); }

}  // namespace talus::analysis
