#pragma once
/// Principal values and ratios of a stress or of an internal moment, (T21) and (T22) of docs/theory.md.

#include "core/types.h"

namespace talus::stress {

/// Stress state of the symmetric part of a tensor.
struct StressState {
  double mean = 0.0;      ///< P = s1 + s2 (the paper's convention: no factor 1/2)
  double deviator = 0.0;  ///< Q = s1 - s2 >= 0
  double ratio = 0.0;     ///< Gamma = Q/P; NaN if P <= 0, as in a grain that carries no load
  double axis = 0.0;      ///< angle of the major principal direction to x, rad, in (-pi/2, pi/2]
};

StressState stress_state(const Tensor2& tensor);

}  // namespace talus::stress
