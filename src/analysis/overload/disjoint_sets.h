#pragma once
/// Sets that grow together (union-find), on a bed that may be periodic.

#include <vector>

#include "core/types.h"

namespace talus::analysis {

/// Disjoint sets of the elements 0 ... count - 1, with path halving. The root of a set is its smallest
/// element. Each element knows by how many periods it is away from its root.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count);

  struct Place {
    Index root;
    Index periods;  ///< from the root to the element
  };
  Place find(Index element);

  /// Joins the sets of a and b, b being `shift` periods away from a. Returns false where they are in one set
  /// already, with another number of periods between them: then the set goes around the period.
  bool join(Index a, Index b, Index shift);

 private:
  std::vector<Index> parent_;
  std::vector<Index> periods_;  ///< from the parent
};

}  // namespace talus::analysis
