#include "stress/bed.h"

#include <algorithm>
#include <cmath>

#include "core/trigonometry.h"

namespace talus {
namespace {

/// Raises the samples that a disk covers to its upper edge. `first` may lie outside: samples are periodic or
/// cut.
void raise_envelope(std::vector<double>& height, double spacing, bool periodic, Vec2 centre, double radius) {
  const auto count = static_cast<Index>(height.size());
  const auto first = static_cast<Index>(std::ceil((centre.x - radius) / spacing - 0.5));
  const auto last = static_cast<Index>(std::floor((centre.x + radius) / spacing - 0.5));
  for (Index k = first; k <= last; ++k) {
    if (!periodic && (k < 0 || k >= count)) continue;
    const double offset = (k + 0.5) * spacing - centre.x;
    const double top = centre.y + std::sqrt(std::max(0.0, radius * radius - offset * offset));
    double& sample = height[static_cast<std::size_t>(((k % count) + count) % count)];
    sample = std::max(sample, top);
  }
}

}  // namespace

double bed_volume(const Grains& grains, const Boundary& boundary, double spacing) {
  const auto count = static_cast<std::size_t>(std::ceil(boundary.length / spacing));
  if (count == 0) return 0.0;
  const double step = boundary.length / static_cast<double>(count);
  std::vector<double> height(count, 0.0);
  for (Index i = 0; i < grains.free_count; ++i)
    raise_envelope(height, step, boundary.periodic, {grains.x[i], grains.y[i]}, grains.radius[i]);
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
