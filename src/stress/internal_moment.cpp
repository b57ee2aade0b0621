#include "stress/internal_moment.h"

#include "core/tensor.h"

namespace talus::stress {

void internal_moments(const Grains& grains, const Contacts& contacts, std::vector<Tensor2>& moments) {
  const Index count = grains.count();
  moments.assign(static_cast<std::size_t>(count), Tensor2{});
  for (Index c = 0; c < contacts.count(); ++c) {
    const Vector2 n{contacts.nx[c], contacts.ny[c]}, t{-contacts.ny[c], contacts.nx[c]};
    const Vector2 f = contacts.fn[c] * n + contacts.ft[c] * t;
    const Index a = contacts.a[c];
    const Index b = contacts.b[c];
    // - r f^T (T19): on a with r = r_a n and the force -f, on b with r = -r_b n and f.
    matrix(moments[a]) += grains.radius[a] * n * f.transpose();
    if (b < count) matrix(moments[b]) += grains.radius[b] * n * f.transpose();  // not a plane
  }
  for (Index i = 0; i < count; ++i) {
    const double rotation = 0.5 * grains.inertia[i] * grains.omega[i] * grains.omega[i];
    matrix(moments[i]).diagonal().array() -= rotation;
  }
}

Tensor2 sum_of_moments(const std::vector<Tensor2>& moments, Index first, Index last) {
  Tensor2 sum;
  for (Index i = first; i < last; ++i) matrix(sum) += matrix(moments[i]);
  return sum;
}

}  // namespace talus::stress
