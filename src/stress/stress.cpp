#include "stress/stress.h"

#include <cmath>

#include "core/tensor.h"

namespace talus::stress {

StressState stress_state(const Tensor2& tensor) {
  const auto m = matrix(tensor);
  const Vector2 deviator{m(0, 0) - m(1, 1), m(0, 1) + m(1, 0)};  // Q (cos 2 axis, sin 2 axis)
  StressState state;
  state.mean = m.trace();                                                    // (T21)
  state.deviator = deviator.norm();                                          // (T21)
  state.ratio = state.mean > 0.0 ? state.deviator / state.mean : not_known;  // (T22)
  // The axis is for display only, and never enters the dynamics.
  state.axis = 0.5 * std::atan2(deviator.y(), deviator.x());
  return state;
}

OverloadCount count_overloaded(const BedFrame& bed, double gamma_c) {
  OverloadCount count;
  for (std::size_t i = 0; i < static_cast<std::size_t>(bed.statics.free_count); ++i) {
    if (!std::isnan(bed.frame.gamma[i])) ++count.loaded;
    if (is_overloaded(bed.frame.gamma[i], gamma_c)) ++count.overloaded;
  }
  return count;
}

}  // namespace talus::stress
