#include "stress/internal_moment.h"

namespace talus {
namespace {

/// Adds lever * n (x) f: what a contact at distance `lever` from the centre gives, the same on both sides as
/// both n and f change sign between them.
void add_contact(Tensor2& moment, double lever, Vec2 normal, Vec2 force) {
  moment.xx += lever * normal.x * force.x;
  moment.xy += lever * normal.x * force.y;
  moment.yx += lever * normal.y * force.x;
  moment.yy += lever * normal.y * force.y;
}

}  // namespace

void internal_moments(const Grains& grains, const Contacts& contacts, std::vector<Tensor2>& moments) {
  const Index count = grains.count();
  moments.assign(static_cast<std::size_t>(count), Tensor2{});
  for (Index c = 0; c < contacts.count(); ++c) {
    const Vec2 normal{contacts.nx[c], contacts.ny[c]};
    const Vec2 force{contacts.fn[c] * normal.x - contacts.ft[c] * normal.y,
                     contacts.fn[c] * normal.y + contacts.ft[c] * normal.x};
    const Index a = contacts.a[c];
    const Index b = contacts.b[c];
    add_contact(moments[a], grains.radius[a], normal, force);
    if (b < count) add_contact(moments[b], grains.radius[b], normal, force);  // not a plane
  }
  for (Index i = 0; i < count; ++i) {
    const double rotation = 0.5 * grains.inertia[i] * grains.omega[i] * grains.omega[i];
    moments[i].xx -= rotation;
    moments[i].yy -= rotation;
  }
}

Tensor2 sum_of_moments(const std::vector<Tensor2>& moments, Index first, Index last) {
  Tensor2 sum;
  for (Index i = first; i < last; ++i) {
    sum.xx += moments[i].xx;
    sum.xy += moments[i].xy;
    sum.yx += moments[i].yx;
    sum.yy += moments[i].yy;
  }
  return sum;
}

}  // namespace talus
