#include "core/world.h"

#include <algorithm>
#include <cmath>

#include "base/hash.h"
#include "core/trigonometry.h"

namespace talus {

void reserve(Grains& grains, std::size_t count) {
  for (std::vector<double> Grains::*field :
       {&Grains::x, &Grains::y, &Grains::vx, &Grains::vy, &Grains::omega, &Grains::radius,
        &Grains::inverse_mass, &Grains::inverse_inertia, &Grains::mass, &Grains::inertia, &Grains::angle})
    (grains.*field).reserve(count);
  grains.image.reserve(count);
}

Index add_disk(Grains& grains, Vec2 centre, double radius, double density, bool fixed) {
  const double mass = density * pi * radius * radius;
  const double inertia = 0.5 * mass * radius * radius;
  grains.x.push_back(centre.x);
  grains.y.push_back(centre.y);
  grains.vx.push_back(0.0);
  grains.vy.push_back(0.0);
  grains.omega.push_back(0.0);
  grains.radius.push_back(radius);
  grains.inverse_mass.push_back(fixed ? 0.0 : 1.0 / mass);
  grains.inverse_inertia.push_back(fixed ? 0.0 : 1.0 / inertia);
  grains.mass.push_back(mass);
  grains.inertia.push_back(inertia);
  grains.angle.push_back(0.0);
  grains.image.push_back(0);
  if (!fixed) ++grains.free_count;
  return grains.count() - 1;
}

void Contacts::resize(std::size_t size) {
  a.resize(size);
  b.resize(size);
  shift.resize(size);
  nx.resize(size);
  ny.resize(size);
  gap.resize(size);
  fn.resize(size);
  ft.resize(size);
  if (!moment.empty()) moment.resize(size);
}

Vec2 gravity_vector(const World& world) {
  return {world.gravity * sine(world.tilt), -world.gravity * cosine(world.tilt)};
}

std::uint64_t state_hash(const World& world) {
  Hasher hash;
  const Grains& g = world.grains;
  hash.add(g.free_count);
  for (const auto* field : {&g.x, &g.y, &g.vx, &g.vy, &g.omega, &g.radius, &g.inverse_mass,
                            &g.inverse_inertia, &g.mass, &g.inertia, &g.angle})
    hash.add_array(*field);
  hash.add_array(g.image);
  hash.add(static_cast<std::uint8_t>(world.boundary.periodic));
  hash.add(world.boundary.length);
  for (const Plane& plane : world.boundary.planes) {
    for (double value : {plane.normal.x, plane.normal.y, plane.offset}) hash.add(value);
    hash.add(static_cast<std::uint8_t>(plane.wall));
  }
  const Contacts& c = world.contacts;
  hash.add_array(c.a);
  hash.add_array(c.b);
  hash.add_array(c.shift);
  hash.add_array(c.fn);
  hash.add_array(c.ft);
  if (!c.moment.empty()) hash.add_array(c.moment);
  hash.add(world.gravity);
  hash.add(world.tilt);
  hash.add(world.time);
  hash.add(world.step);
  return hash.value();
}

double rms_velocity(const Grains& grains) {
  double sum = 0.0;
  for (Index i = 0; i < grains.free_count; ++i) {
    const double rim = grains.radius[i] * grains.omega[i];
    sum += grains.vx[i] * grains.vx[i] + grains.vy[i] * grains.vy[i] + rim * rim;
  }
  return grains.free_count > 0 ? std::sqrt(sum / grains.free_count) : 0.0;
}

double kinetic_energy(const Grains& grains) {
  double sum = 0.0;
  for (Index i = 0; i < grains.free_count; ++i)
    sum += 0.5 * grains.mass[i] * (grains.vx[i] * grains.vx[i] + grains.vy[i] * grains.vy[i]) +
           0.5 * grains.inertia[i] * grains.omega[i] * grains.omega[i];
  return sum;
}

Motion motion_of(const Grains& grains) {
  double squares = 0.0, energy = 0.0, fastest = 0.0, mass = 0.0;
  for (Index i = 0; i < grains.free_count; ++i) {
    const double vx = grains.vx[i] * grains.vx[i], vy = grains.vy[i] * grains.vy[i];
    const double rim = grains.radius[i] * grains.omega[i];
    squares += vx + vy + rim * rim;
    energy += 0.5 * grains.mass[i] * (vx + vy) + 0.5 * grains.inertia[i] * grains.omega[i] * grains.omega[i];
    fastest = std::max(fastest, vx + vy);
    mass += grains.mass[i];
  }
  return {grains.free_count > 0 ? std::sqrt(squares / grains.free_count) : 0.0, energy, std::sqrt(fastest),
          mass};
}

}  // namespace talus
