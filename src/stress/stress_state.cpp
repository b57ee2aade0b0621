#include "stress/stress_state.h"

#include <cmath>
#include <limits>

namespace talus {

StressState stress_state(const Tensor2& tensor) {
  const double difference = tensor.xx - tensor.yy;
  const double shear = tensor.xy + tensor.yx;  // twice the symmetric shear component
  StressState state;
  state.mean = tensor.xx + tensor.yy;
  state.deviator = std::sqrt(difference * difference + shear * shear);
  state.ratio = state.mean > 0.0 ? state.deviator / state.mean : std::numeric_limits<double>::quiet_NaN();
  state.axis = 0.5 * std::atan2(shear, difference);  // for display only: never enters the dynamics
  return state;
}

}  // namespace talus
