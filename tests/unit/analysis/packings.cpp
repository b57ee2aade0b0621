#include "unit/analysis/packings.h"

#include <cmath>

#include "core/random.h"
#include "core/trigonometry.h"
#include "stress/stress.h"

namespace talus::test {
namespace {

Index append(Packing& packing, double x, double y, double radius, Tensor2 moment) {
  packing.frame.x.push_back(x);
  packing.frame.y.push_back(y);
  packing.frame.omega.push_back(0.0);
  packing.frame.internal_moment.push_back(moment);
  packing.frame.gamma.push_back(stress::stress_state(moment).ratio);
  packing.statics.radius.push_back(radius);
  return packing.frame.grain_count() - 1;
}

double modulo(double x, double length) { return x - length * std::floor(x / length); }

}  // namespace

Packing empty_packing(double length, bool periodic) {
  Packing packing;
  packing.statics.length = length;
  packing.statics.periodic = periodic;
  packing.statics.mean_diameter = 1.0;
  packing.frame.friction.grains = 0.5;
  return packing;
}

Index add_grain(Packing& packing, double x, double y, double radius, Tensor2 moment) {
  ++packing.statics.free_count;
  return append(packing, x, y, radius, moment);
}

Index add_floor_grain(Packing& packing, double x, double y, double radius) {
  return append(packing, x, y, radius, {});
}

void add_contact(Packing& packing, Index a, Index b, double fn, double ft, int shift) {
  const Frame& frame = packing.frame;
  const bool with_wall = b >= frame.grain_count();
  const double dx = with_wall ? 1.0 : frame.x[b] + shift * packing.statics.length - frame.x[a];
  const double dy = with_wall ? 0.0 : frame.y[b] - frame.y[a];
  const double distance = std::hypot(dx, dy);
  FrameContacts& contacts = packing.frame.contacts;
  contacts.a.push_back(a);
  contacts.b.push_back(b);
  contacts.shift.push_back(static_cast<std::int8_t>(shift));
  contacts.nx.push_back(dx / distance);
  contacts.ny.push_back(dy / distance);
  contacts.px.push_back(frame.x[a] + packing.statics.radius[a] * dx / distance);
  contacts.py.push_back(frame.y[a] + packing.statics.radius[a] * dy / distance);
  contacts.fn.push_back(fn);
  contacts.ft.push_back(ft);
  contacts.status.push_back(stress::contact_status(fn, ft, packing.frame.friction.grains));
}

void add_left_wall_contact(Packing& packing, Index a, double fn, double ft) {
  add_contact(packing, a, packing.frame.grain_count(), fn, ft);
  packing.frame.contacts.nx.back() = -1.0;
  packing.frame.contacts.px.back() = packing.frame.x[a] - packing.statics.radius[a];
}

void moments_from_contacts(Packing& packing) {
  Grains grains;
  grains.free_count = packing.statics.free_count;
  grains.radius = packing.statics.radius;
  grains.omega = packing.frame.omega;
  grains.inertia.assign(grains.radius.size(), 0.0);
  Contacts contacts;
  contacts.a = packing.frame.contacts.a;
  contacts.b = packing.frame.contacts.b;
  contacts.shift = packing.frame.contacts.shift;
  contacts.nx = packing.frame.contacts.nx;
  contacts.ny = packing.frame.contacts.ny;
  contacts.gap.assign(contacts.a.size(), 0.0);
  contacts.fn = packing.frame.contacts.fn;
  contacts.ft = packing.frame.contacts.ft;
  stress::internal_moments(grains, contacts, packing.frame.internal_moment);
  gamma_from_moments(packing);
}

void gamma_from_moments(Packing& packing) {
  for (std::size_t i = 0; i < packing.frame.gamma.size(); ++i)
    packing.frame.gamma[i] = stress::stress_state(packing.frame.internal_moment[i]).ratio;
}

Packing triangular_lattice(Index columns, Index rows, bool periodic) {
  Packing packing = empty_packing(columns, periodic);
  for (Index row = 0; row < rows; ++row)
    for (Index column = 0; column < columns; ++column)
      add_grain(packing, column + (row % 2 == 0 ? 0.25 : 0.75), 0.5 + row * std::sqrt(0.75));
  return packing;
}

Packing random_packing(std::uint64_t seed, Index count, double length, double height, bool periodic) {
  Random random(seed);
  const auto place = [&](double end) {
    return random.below(static_cast<std::uint32_t>(end * 1024.0)) / 1024.0;
  };
  Packing packing = empty_packing(length, periodic);
  for (Index i = 0; i < count; ++i) {
    const double x = place(length);
    const double y = place(height);
    const double large = random.uniform();
    const double small = large * random.uniform();
    const double angle = random.uniform(-0.5 * pi, 0.5 * pi);
    const double c = cosine(angle);
    const double s = sine(angle);
    const double shear = (large - small) * c * s;
    add_grain(packing, x, y, random.uniform(0.4, 0.6),
              {large * c * c + small * s * s, shear, shear, large * s * s + small * c * c});
  }
  return packing;
}

Packing moved(Packing packing, double shift) {
  for (double& x : packing.frame.x) x = modulo(x + shift, packing.statics.length);
  return packing;
}

Packing mirrored(Packing packing) {
  for (Index i = 0; i < packing.frame.grain_count(); ++i) {
    const double x = packing.statics.length - packing.frame.x[i];
    packing.frame.x[i] = packing.statics.periodic ? modulo(x, packing.statics.length) : x;
    Tensor2& moment = packing.frame.internal_moment[i];
    moment.xy = -moment.xy;
    moment.yx = -moment.yx;
  }
  return packing;
}

}  // namespace talus::test
