#pragma once
/// Determinants and inverses of Eigen matrices. They take longer to compile than core/tensor.h, and are
/// therefore separate.

#include <Eigen/LU>

#include "core/tensor.h"
