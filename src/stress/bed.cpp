#include "stress/bed.h"

#include <cmath>

#include "core/trigonometry.h"
#include "stress/free_surface.h"

namespace talus {

double bed_volume(const Grains& grains, const Boundary& boundary, double spacing) {
  const std::vector<double> height = free_surface(grains, boundary, spacing);
  if (height.empty()) return 0.0;
  const double step = boundary.length / static_cast<double>(height.size());
  double sum = 0.0;
  for (double sample : height) sum += sample;
  return sum * step;
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

double coordination_number(const Grains& grains, const Contacts& contacts) {
  std::vector<Index> degree(static_cast<std::size_t>(grains.count()), 0);
  for (Index c = 0; c < contacts.count(); ++c) {
    if (!(contacts.fn[c] > 0.0)) continue;
    ++degree[contacts.a[c]];
    if (contacts.b[c] < grains.count()) ++degree[contacts.b[c]];
  }
  Index carrying = 0;
  Index ends = 0;
  for (Index i = 0; i < grains.free_count; ++i) {
    ends += degree[i];
    if (degree[i] > 0) ++carrying;
  }
  return carrying > 0 ? static_cast<double>(ends) / carrying : 0.0;
}

}  // namespace talus
