#pragma once
/// Pairs of neighbouring grains, from which clusters are built.

#include <cstdint>
#include <vector>

#include "core/bed_frame.h"

namespace talus::analysis {

/// Two free grains, a < b. Seen from a, grain b is at x_b + shift * period.
struct Link {
  Index a = 0, b = 0;
  std::int8_t shift = 0;
};

/// Returns the pairs of free grains in a contact that carries force. Floor grains and walls do not link.
std::vector<Link> force_links(const BedFrame& bed);

/// Returns the pairs of free grains whose centres are closer than `reach` times the sum of their radii:
/// nearest neighbours, in contact or not. With 1.1 the gap is less than a tenth of the mean diameter of the
/// pair. Each pair occurs once, with its nearest image, in the order of (a, b).
std::vector<Link> neighbour_links(const BedFrame& bed, double reach = 1.1);

}  // namespace talus::analysis
