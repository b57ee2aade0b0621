#include "analysis/overload/clusters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/random.h"

namespace talus::analysis {
namespace {

using Graph = std::vector<std::vector<Index>>;

/// Assigns `label` to everything connected to `start` that has no label.
Index flood(const Graph& graph, std::vector<Index>& labels, Index start, Index label) {
  std::vector<Index> open = {start};
  Index size = 0;
  labels[start] = label;
  while (!open.empty()) {
    const Index i = open.back();
    open.pop_back();
    ++size;
    for (Index j : graph[i])
      if (labels[j] == -1) {
        labels[j] = label;
        open.push_back(j);
      }
  }
  return size;
}

std::vector<Link> random_links(Random& random, Index count, int number) {
  std::vector<Link> links;
  for (int k = 0; k < number; ++k) {
    const auto a = static_cast<Index>(random.below(static_cast<std::uint32_t>(count)));
    const auto b = static_cast<Index>(random.below(static_cast<std::uint32_t>(count)));
    if (a != b) links.push_back({std::min(a, b), std::max(a, b), 0});
  }
  return links;
}

TEST(Clusters, are_those_of_a_flood_fill) {
  constexpr Index count = 300;
  Random random(11);
  for (const int number : {100, 250, 400, 1000}) {
    const std::vector<Link> links = random_links(random, count, number);
    std::vector<bool> in_set(count);
    for (Index i = 0; i < count; ++i) in_set[i] = random.uniform() < 0.8;
    const Clusters clusters = find_clusters(in_set, links, std::vector<double>(count, 0.0), 0.0);

    Graph graph(count);
    for (const Link& link : links)
      if (in_set[link.a] && in_set[link.b]) {
        graph[link.a].push_back(link.b);
        graph[link.b].push_back(link.a);
      }
    std::vector<Index> flooded(count, -1);
    for (Index i = 0; i < count; ++i) {
      if (!in_set[i]) {
        EXPECT_EQ(clusters.label[i], -1);
      } else if (flooded[i] == -1) {
        const Index label = clusters.label[i];
        ASSERT_TRUE(label >= 0 && label < clusters.count());
        EXPECT_EQ(flood(graph, flooded, i, label), clusters.size[label]);
      }
    }
    EXPECT_EQ(flooded, clusters.label);
    // Larger clusters first; among equal ones, the one that begins first.
    std::vector<std::pair<Index, std::ptrdiff_t>> order;
    for (Index k = 0; k < clusters.count(); ++k)
      order.emplace_back(-clusters.size[k], std::ranges::find(clusters.label, k) - clusters.label.begin());
    EXPECT_TRUE(std::ranges::is_sorted(order));
    EXPECT_EQ(clusters.members, std::ranges::count(in_set, true));
  }
}

TEST(Clusters, are_ordered_by_size_and_then_by_id) {
  const std::vector<bool> in_set = {true, true, true, true, true, false, true, true};
  const std::vector<Link> links = {{1, 4}, {2, 3}, {4, 7}, {5, 6}, {0, 5}};
  const Clusters clusters = find_clusters(in_set, links, std::vector<double>(8, 0.0), 0.0);
  EXPECT_EQ(clusters.label, (std::vector<Index>{2, 0, 1, 1, 0, -1, 3, 0}));
  EXPECT_EQ(clusters.size, (std::vector<Index>{3, 2, 1, 1}));
  EXPECT_EQ(clusters.members, 7);
  EXPECT_EQ(mean_size(clusters), 7.0 / 4.0);
  EXPECT_EQ(largest_size(clusters), 3);
  EXPECT_EQ(largest_share(clusters), 3.0 / 7.0);
  EXPECT_EQ(second_moment(clusters), 15.0 / 7.0);
  EXPECT_EQ(second_moment_of_others(clusters), 6.0 / 4.0);
}

TEST(Clusters, of_an_empty_set) {
  const Clusters clusters = find_clusters({false, false}, {{0, 1}}, {0.0, 1.0}, 0.0);
  EXPECT_EQ(clusters.count(), 0);
  EXPECT_TRUE(std::isnan(mean_size(clusters)) && std::isnan(second_moment(clusters)));
  EXPECT_TRUE(std::isnan(correlation_length(clusters, {0.0, 0.0})));
}

/// Returns links from each of 0 ... 9 to the next, at x = 0.5 ... 9.5 in a period of 10.
std::vector<Link> ring() {
  std::vector<Link> links;
  for (Index i = 0; i + 1 < 10; ++i) links.push_back({i, i + 1, 0});
  links.push_back({0, 9, -1});
  return links;
}

TEST(Clusters, that_go_around_the_period_wrap) {
  std::vector<double> x;
  for (Index i = 0; i < 10; ++i) x.push_back(i + 0.5);
  std::vector<bool> in_set(10, true);
  EXPECT_TRUE(find_clusters(in_set, ring(), x, 10.0).wraps[0]);
  for (Index missing = 0; missing < 10; ++missing) {
    in_set.assign(10, true);
    in_set[missing] = false;
    const Clusters clusters = find_clusters(in_set, ring(), x, 10.0);
    EXPECT_EQ(clusters.count(), 1);
    EXPECT_FALSE(clusters.wraps[0]);
    // Unwrapped, the nine grains lie next to each other.
    double lowest = 1e9, highest = -1e9;
    for (Index i = 0; i < 10; ++i)
      if (in_set[i]) {
        lowest = std::min(lowest, clusters.unrolled[i]);
        highest = std::max(highest, clusters.unrolled[i]);
      }
    EXPECT_EQ(highest - lowest, 8.0);
  }
  // A loop that crosses the edge and returns through it does not wrap around.
  EXPECT_FALSE(
      find_clusters({true, true, true}, {{0, 1, -1}, {0, 2, -1}, {1, 2, 0}}, {0.5, 9.5, 9.0}, 10.0).wraps[0]);
}

// Links in any order, so that merging roots have offsets on both sides.
TEST(Clusters, wrap_whatever_the_order_of_links) {
  std::vector<double> x;
  for (Index i = 0; i < 10; ++i) x.push_back(i + 0.5);
  Random random(12);
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<Link> links = ring();
    for (std::size_t k = links.size() - 1; k > 0; --k)
      std::swap(links[k], links[random.below(static_cast<std::uint32_t>(k + 1))]);
    EXPECT_TRUE(find_clusters(std::vector<bool>(10, true), links, x, 10.0).wraps[0]);
    links.pop_back();
    const Clusters open = find_clusters(std::vector<bool>(10, true), links, x, 10.0);
    EXPECT_FALSE(open.wraps[0]);
    const auto [lowest, highest] = std::ranges::minmax(open.unrolled);
    EXPECT_EQ(highest - lowest, 9.0);
  }
}

// R^2 of two grains at distance d is d^2/4, and for a single pair xi = d / sqrt(2). Pairs count with s^2 = 4;
// single grains and wrapping clusters do not count.
TEST(CorrelationLength, of_pairs) {
  const std::vector<double> x = {9.5, 0.5, 3.0, 3.0, 6.0};
  const std::vector<double> y = {0.0, 0.0, 0.0, 3.0, 5.0};
  const std::vector<Link> one = {{0, 1, 1}};
  const std::vector<Link> two = {{0, 1, 1}, {2, 3, 0}};
  const auto length = [&](const std::vector<Link>& links) {
    return correlation_length(find_clusters(std::vector<bool>(5, true), links, x, 10.0), y);
  };
  EXPECT_NEAR(length(one), 1.0 / std::sqrt(2.0), 1e-15);
  EXPECT_NEAR(length(two), std::sqrt(2.0 * (0.25 + 2.25) / 2.0), 1e-15);
  EXPECT_NEAR(length({{0, 1, 1}, {0, 1, 0}, {2, 3, 0}}), std::sqrt(2.0 * 2.25), 1e-15);
}

}  // namespace
}  // namespace talus::analysis
