#include "analysis/overload/disjoint_sets.h"

#include <algorithm>
#include <numeric>

namespace talus::analysis {

DisjointSets::DisjointSets(std::size_t count) : parent_(count), periods_(count, 0) {
  std::iota(parent_.begin(), parent_.end(), 0);
}

DisjointSets::Place DisjointSets::find(Index element) {
  Index periods = 0;
  while (parent_[element] != element) {
    const Index up = parent_[element];
    periods_[element] += periods_[up];  // 0 if `up` is a root
    parent_[element] = parent_[up];
    periods += periods_[element];
    element = parent_[element];
  }
  return {element, periods};
}

bool DisjointSets::join(Index a, Index b, Index shift) {
  const Place place_a = find(a);
  const Place place_b = find(b);
  if (place_a.root == place_b.root) return place_b.periods == place_a.periods + shift;
  const Index between = place_a.periods + shift - place_b.periods;  // from the root of a to the root of b
  const Index high = std::max(place_a.root, place_b.root);
  parent_[high] = std::min(place_a.root, place_b.root);
  periods_[high] = high == place_b.root ? between : -between;
  return true;
}

}  // namespace talus::analysis
