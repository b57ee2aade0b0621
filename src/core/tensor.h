#pragma once
/// Vectors and tensors of the plane as Eigen matrices, for expressions such as
/// matrix(M) += r * f.transpose().

#include <Eigen/Core>
#include <Eigen/LU>

#include "core/types.h"

namespace talus {

using Vector2 = Eigen::Vector2d;

/// Matrix view of the four numbers of a tensor.
using Matrix2 = Eigen::Matrix<double, 2, 2, Eigen::RowMajor>;
static_assert(sizeof(Tensor2) == sizeof(Matrix2));
inline Eigen::Map<Matrix2> matrix(Tensor2& tensor) { return Eigen::Map<Matrix2>(&tensor.xx); }
inline Eigen::Map<const Matrix2> matrix(const Tensor2& tensor) {
  return Eigen::Map<const Matrix2>(&tensor.xx);
}
inline Tensor2 tensor(const Matrix2& m) { return {m(0, 0), m(0, 1), m(1, 0), m(1, 1)}; }

}  // namespace talus
