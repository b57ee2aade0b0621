#pragma once
/// Determinants and inverses of matrices of Eigen, which take longer to compile than the rest of
/// core/tensor.h.

#include <Eigen/LU>

#include "core/tensor.h"
