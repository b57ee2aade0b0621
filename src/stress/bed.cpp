#include "stress/bed.h"

#include <cmath>

#include "core/trigonometry.h"

namespace talus::stress {

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
  std::vector<Index> contacts(static_cast<std::size_t>(count), 0);
  for (const auto bodies : {a, b})
    for (const Index body : bodies)
      if (body < count) ++contacts[static_cast<std::size_t>(body)];
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
