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

std::vector<Index> loaded_contacts(std::span<const Index> a, std::span<const Index> b,
                                   std::span<const double> fn, Index free_count) {
  std::vector<Index> count(static_cast<std::size_t>(free_count), 0);
  for (std::size_t c = 0; c < fn.size(); ++c)
    for (const Index body : {a[c], b[c]})
      if (body < free_count && fn[c] > 0.0) ++count[static_cast<std::size_t>(body)];
  return count;
}

double coordination_number(std::span<const Index> loaded_contacts) {
  Index ends = 0, carrying = 0;
  for (const Index each : loaded_contacts) {
    ends += each;
    carrying += each > 0 ? 1 : 0;
  }
  return carrying > 0 ? static_cast<double>(ends) / carrying : 0.0;
}

double coordination_number(const Grains& grains, const Contacts& contacts) {
  return coordination_number(loaded_contacts(contacts.a, contacts.b, contacts.fn, grains.free_count));
}

}  // namespace talus::stress
