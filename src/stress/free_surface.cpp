#include "stress/free_surface.h"

#include <algorithm>
#include <cmath>

#include "core/trigonometry.h"

namespace talus {
namespace {

/// Samples are looked at in blocks of so many: a disk below the lowest sample of each block that it covers,
/// as nearly all of a bed are, raises none.
constexpr Index samples_of_block = 16;

/// The upper edges of disks at evenly spaced samples.
struct Envelope {
  std::vector<double> height;
  std::vector<double> lowest;  ///< of each block, or less
  double spacing;
  bool periodic;

  Envelope(std::size_t samples, double length, bool is_periodic)
      : height(samples, 0.0),
        lowest((samples + samples_of_block - 1) / samples_of_block, 0.0),
        spacing(length / static_cast<double>(samples)),
        periodic(is_periodic) {}

  Index count() const { return static_cast<Index>(height.size()); }

  /// Raises samples first ... last of one block that a disk covers to its upper edge. The disk is seen from
  /// sample k as from place k + shift, which is another one where it is a periodic image that covers them.
  void raise_block(Index first, Index last, Index shift, Vec2 centre, double radius) {
    const double highest = centre.y + radius;
    double& low = lowest[static_cast<std::size_t>(first / samples_of_block)];
    if (low >= highest) return;
    for (Index k = first; k <= last; ++k) {
      double& sample = height[static_cast<std::size_t>(k)];
      if (sample >= highest) continue;
      const double offset = (k + shift + 0.5) * spacing - centre.x;
      sample = std::max(sample, centre.y + std::sqrt(std::max(0.0, radius * radius - offset * offset)));
    }
    const Index begin = first / samples_of_block * samples_of_block;
    low = *std::min_element(height.begin() + begin,
                            height.begin() + std::min(begin + samples_of_block, count()));
  }

  /// The samples may lie outside: they are periodic or cut.
  void raise(Vec2 centre, double radius) {
    auto k = static_cast<Index>(std::ceil((centre.x - radius) / spacing - 0.5));
    auto last = static_cast<Index>(std::floor((centre.x + radius) / spacing - 0.5));
    if (!periodic) {
      k = std::max(k, 0);
      last = std::min(last, count() - 1);
    }
    while (k <= last) {
      Index place = k;
      while (place < 0) place += count();
      while (place >= count()) place -= count();
      const Index end =
          std::min({(place / samples_of_block + 1) * samples_of_block, count(), place + last - k + 1});
      raise_block(place, end - 1, k - place, centre, radius);
      k += end - place;
    }
  }
};

}  // namespace

std::vector<double> free_surface(const Grains& grains, const Boundary& boundary, double spacing) {
  const auto samples = static_cast<std::size_t>(std::ceil(boundary.length / spacing));
  if (samples == 0) return {};
  Envelope envelope(samples, boundary.length, boundary.periodic);
  // The last grains first: they are at the surface, and most of the others below what they leave.
  for (Index i = grains.free_count - 1; i >= 0; --i)
    envelope.raise({grains.x[i], grains.y[i]}, grains.radius[i]);
  return std::move(envelope.height);
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
