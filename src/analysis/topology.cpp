#include "analysis/topology.h"

#include <algorithm>
#include <numeric>

#include "analysis/disjoint_sets.h"

namespace talus {
namespace {

/// Contacts between free grains, the largest normal force first.
std::vector<Index> contacts_by_force(const BedFrame& bed) {
  const FrameContacts& contacts = bed.frame.contacts;
  std::vector<Index> order;
  for (Index c = 0; c < contacts.count(); ++c)
    if (contacts.a[c] < bed.statics.free_count && contacts.b[c] < bed.statics.free_count) order.push_back(c);
  std::ranges::stable_sort(order, std::ranges::greater(), [&](Index c) { return contacts.fn[c]; });
  return order;
}

/// A graph that grows edge by edge.
class GrowingGraph {
 public:
  explicit GrowingGraph(Index vertices)
      : sets_(static_cast<std::size_t>(vertices)), touched_(static_cast<std::size_t>(vertices), false) {}

  void add_edge(Index a, Index b) {
    for (const Index end : {a, b}) {
      if (!touched_[end]) ++count_.components;
      touched_[end] = true;
    }
    if (sets_.find(a).root == sets_.find(b).root)
      ++count_.loops;
    else
      --count_.components;
    sets_.join(a, b, 0);
  }

  GraphCount count() const { return count_; }

 private:
  DisjointSets sets_;
  std::vector<bool> touched_;
  GraphCount count_;
};

}  // namespace

std::vector<GraphCount> count_networks(const BedFrame& bed, std::span<const double> thresholds) {
  const FrameContacts& contacts = bed.frame.contacts;
  std::vector<std::size_t> descending(thresholds.size());
  std::iota(descending.begin(), descending.end(), std::size_t{0});
  std::ranges::stable_sort(descending, std::ranges::greater(), [&](std::size_t k) { return thresholds[k]; });
  const std::vector<Index> order = contacts_by_force(bed);
  GrowingGraph graph(bed.statics.free_count);
  std::vector<GraphCount> counts(thresholds.size());
  auto next = order.begin();
  for (const std::size_t k : descending) {
    for (; next != order.end() && contacts.fn[*next] >= thresholds[k]; ++next)
      graph.add_edge(contacts.a[*next], contacts.b[*next]);
    counts[k] = graph.count();
  }
  return counts;
}

void take_topology(const BedFrame& bed, std::span<const double> thresholds, FrameRecord& record) {
  std::vector<double> forces(thresholds.begin(), thresholds.end());
  for (double& force : forces) force *= record.mean_normal_force;
  for (const GraphCount& count : count_networks(bed, forces)) {
    record.network_components.push_back(count.components);
    record.network_loops.push_back(count.loops);
  }
}

}  // namespace talus
