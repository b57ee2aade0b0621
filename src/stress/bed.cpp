#include <cmath>

#include "core/tensor.h"
#include "core/trigonometry.h"
#include "stress/stress.h"

namespace talus::stress {

void internal_moments(const Grains& grains, const Contacts& contacts, std::vector<Tensor2>& moments) {
  const Index count = grains.count();
  moments.assign(count, Tensor2{});
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

double solid_area(const Grains& grains) {
  double sum = 0.0;
  for (Index i = 0; i < grains.free_count; ++i) sum += grains.radius[i] * grains.radius[i];
  return pi * sum;
}

double centre_of_mass_height(const Grains& grains) {
  double moment = 0.0;
  double mass = 0.0;
  for (Index i = 0; i < grains.free_count; ++i) {
    moment += grains.mass[i] * grains.y[i];
    mass += grains.mass[i];
  }
  return mass > 0.0 ? moment / mass : 0.0;
}

ContactStatus contact_status(double fn, double ft, double friction, double tolerance) {
  if (!(fn > 0.0)) return ContactStatus::open;
  return std::fabs(ft) >= (friction - tolerance) * fn ? ContactStatus::sliding : ContactStatus::sticking;
}

std::vector<Index> contacts_of_grains(std::span<const Index> a, std::span<const Index> b, Index count) {
  std::vector<Index> contacts(count, 0);
  for (const auto bodies : {a, b})
    for (const Index body : bodies)
      if (body < count) ++contacts[body];
  return contacts;
}

double coordination_number(std::span<const Index> contacts_of_grains) {
  Index ends = 0, carrying = 0;
  for (const Index each : contacts_of_grains) {
    ends += each;
    carrying += each > 0 ? 1 : 0;
  }
  return carrying > 0 ? static_cast<double>(ends) / carrying : 0.0;
}

}  // namespace talus::stress
