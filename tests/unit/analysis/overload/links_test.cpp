#include "analysis/overload/links.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "unit/analysis/packings.h"

namespace talus::analysis {
namespace {

using test::Packing;

std::vector<std::pair<Index, Index>> pairs(const std::vector<Link>& links) {
  std::vector<std::pair<Index, Index>> result;
  for (const Link& link : links) result.emplace_back(link.a, link.b);
  return result;
}

TEST(ForceLinks, join_free_grains_that_press_on_each_other) {
  Packing packing = test::empty_packing(10.0, true);
  const Index a = test::add_grain(packing, 0.25, 0.5);
  const Index b = test::add_grain(packing, 9.25, 0.5);
  const Index floor = test::add_floor_grain(packing, 0.25, -0.5);
  test::add_contact(packing, a, b, 1.0, 0.0, -1);
  test::add_contact(packing, a, floor, 1.0);
  const std::vector<Link> links = force_links(packing);
  ASSERT_EQ(links.size(), 1u);
  EXPECT_EQ(links[0].a, a);
  EXPECT_EQ(links[0].b, b);
  EXPECT_EQ(links[0].shift, -1);
}

TEST(NeighbourLinks, are_all_pairs_closer_than_the_reach) {
  for (const bool periodic : {false, true}) {
    const Packing packing = test::random_packing(7, 300, 20.0, 12.0, periodic);
    const Frame& frame = packing.frame;
    std::vector<std::pair<Index, Index>> expected;
    for (Index a = 0; a < 300; ++a)
      for (Index b = a + 1; b < 300; ++b) {
        double dx = std::fabs(frame.x[b] - frame.x[a]);
        if (periodic) dx = std::min(dx, 20.0 - dx);
        if (std::hypot(dx, frame.y[b] - frame.y[a]) <
            1.3 * (packing.statics.radius[a] + packing.statics.radius[b]))
          expected.emplace_back(a, b);
      }
    const std::vector<Link> links = neighbour_links({frame, packing.statics}, 1.3);
    EXPECT_EQ(pairs(links), expected);
    for (const Link& link : links)
      EXPECT_LT(std::fabs(frame.x[link.b] + 20.0 * link.shift - frame.x[link.a]), 2.0);
    EXPECT_EQ(std::ranges::any_of(links, [](const Link& link) { return link.shift != 0; }), periodic);
  }
}

TEST(NeighbourLinks, of_a_triangular_lattice) {
  const Packing packing = test::triangular_lattice(10, 10, true);
  // Three links per grain, except one per grain in the top row.
  EXPECT_EQ(neighbour_links(packing).size(), 3u * 90 + 10);
  EXPECT_TRUE(neighbour_links(packing, 0.99).empty());
}

}  // namespace
}  // namespace talus::analysis
