#include "stress/free_surface.h"

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
  const double highest = centre.y + radius;
  for (Index k = first; k <= last; ++k) {
    if (!periodic && (k < 0 || k >= count)) continue;
    Index place = k;
    while (place < 0) place += count;
    while (place >= count) place -= count;
    double& sample = height[static_cast<std::size_t>(place)];
    if (sample >= highest) continue;
    const double offset = (k + 0.5) * spacing - centre.x;
    sample = std::max(sample, centre.y + std::sqrt(std::max(0.0, radius * radius - offset * offset)));
  }
}

}  // namespace

std::vector<double> free_surface(const Grains& grains, const Boundary& boundary, double spacing) {
  std::vector<double> height(static_cast<std::size_t>(std::ceil(boundary.length / spacing)), 0.0);
  if (height.empty()) return height;
  const double step = boundary.length / static_cast<double>(height.size());
  // The last grains first: they are at the surface, and most of the others below what they leave.
  for (Index i = grains.free_count - 1; i >= 0; --i)
    raise_envelope(height, step, boundary.periodic, {grains.x[i], grains.y[i]}, grains.radius[i]);
  return height;
}

double surface_inclination(const Grains& grains, const Boundary& boundary, double spacing) {
  if (boundary.periodic) return 0.0;
  const std::vector<double> height = free_surface(grains, boundary, spacing);
  const double step = boundary.length / static_cast<double>(height.size());
  const std::size_t first = height.size() / 4;
  const std::size_t last = height.size() - first;
  // About the middle of the bed, so that the sum of the distances is zero.
  const double middle = 0.5 * static_cast<double>(height.size() - 1);
  double moment = 0.0, squares = 0.0;
  for (std::size_t k = first; k < last; ++k) {
    const double distance = step * (static_cast<double>(k) - middle);
    moment += distance * height[k];
    squares += distance * distance;
  }
  return squares > 0.0 ? arctangent(moment / squares) : 0.0;
}

}  // namespace talus
