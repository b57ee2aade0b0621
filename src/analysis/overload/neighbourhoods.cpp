#include "analysis/overload/neighbourhoods.h"

#include <algorithm>
#include <array>

namespace talus::analysis {

std::size_t sort_nearest(std::vector<Neighbour>& neighbours, double low, double high,
                         std::vector<Neighbour>& scratch) {
  // The squared distances of grains that are evenly spread over an area are uniformly distributed, so this
  // number of buckets gives about one grain each.
  constexpr Index max_buckets = 256;
  const Index buckets = std::clamp<Index>(static_cast<Index>(neighbours.size()), 1, max_buckets);
  const double scale = std::isfinite(high) && high > low ? buckets / (high - low) : 0.0;
  const auto bucket_of = [&](const Neighbour& one) {
    if (one.square > high) return buckets;
    return std::min(buckets - 1, static_cast<Index>((one.square - low) * scale));
  };
  std::array<Index, max_buckets + 2> start;
  std::fill_n(start.begin(), buckets + 2, 0);
  for (const Neighbour& one : neighbours) ++start[bucket_of(one) + 1];
  for (Index k = 1; k <= buckets; ++k) start[k] += start[k - 1];
  const auto count = static_cast<std::size_t>(start[buckets]);
  scratch.resize(neighbours.size());
  for (const Neighbour& one : neighbours) scratch[start[bucket_of(one)]++] = one;
  neighbours.swap(scratch);
  // Only the order within a bucket may still be wrong.
  for (std::size_t k = 1; k < count; ++k) {
    const Neighbour one = neighbours[k];
    std::size_t place = k;
    for (; place > 0 && one < neighbours[place - 1]; --place) neighbours[place] = neighbours[place - 1];
    neighbours[place] = one;
  }
  return count;
}

}  // namespace talus::analysis
