#pragma once
/// Pairs of grains that are side by side: what clusters are made of.

#include <cstdint>
#include <vector>

#include "core/bed_frame.h"

namespace talus::analysis {

/// Two free grains, a < b; b is at x_b + shift * period, seen from a.
struct Link {
  Index a = 0, b = 0;
  std::int8_t shift = 0;
};

/// Pairs of free grains that touch with a force. Floor grains and walls do not link.
std::vector<Link> force_links(const BedFrame& bed);

/// Pairs of free grains whose centres are closer than `reach` times the sum of their radii: nearest
/// neighbours, whether they touch or not. With 1.1 the gap between them is less than a tenth of their mean
/// diameter. Each pair once, with its nearest image. In the order of (a, b).
std::vector<Link> neighbour_links(const BedFrame& bed, double reach = 1.1);

}  // namespace talus::analysis
