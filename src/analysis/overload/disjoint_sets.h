#pragma once
/// Disjoint sets (union-find) in a bed that may be periodic.

#include <vector>

#include "core/types.h"

namespace talus::analysis {

/// Disjoint sets of the elements 0 ... count - 1, with path halving. The root of a set is its smallest
/// element. The number of periods between each element and its root is known.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count);

  struct Place {
    Index root;
    Index periods;  ///< periods from the root to the element
  };
  /// Returns the root of the set of an element, and the periods between them.
  Place find(Index element);

  /// Joins the sets of a and b, where b is `shift` periods away from a. Returns false if they already belong
  /// to one set with a different number of periods between them: the set then closes on itself around the
  /// period.
  bool join(Index a, Index b, Index shift);

 private:
  std::vector<Index> parent_;
  std::vector<Index> periods_;  ///< periods from the parent
};

}  // namespace talus::analysis
