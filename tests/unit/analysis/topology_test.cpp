#include "analysis/topology.h"

#include <gtest/gtest.h>

#include "unit/analysis/packings.h"

namespace talus {
namespace {

using test::Packing;

/// Two triangles with a bridge between them, which stand on a floor grain.
Packing two_triangles() {
  Packing packing = test::empty_packing(10.0, false);
  for (Index i = 0; i < 7; ++i) test::add_grain(packing, static_cast<double>(i), 0.5);
  const Index floor = test::add_floor_grain(packing, 0.0, -0.5);
  test::add_contact(packing, 0, 1, 4.0);
  test::add_contact(packing, 1, 2, 3.0);
  test::add_contact(packing, 0, 2, 2.0);
  test::add_contact(packing, 3, 4, 4.0);
  test::add_contact(packing, 4, 5, 3.0);
  test::add_contact(packing, 3, 5, 3.0);
  test::add_contact(packing, 2, 3, 1.0);
  test::add_contact(packing, 0, floor, 9.0);
  test::add_contact(packing, 5, floor, 9.0);
  return packing;
}

std::vector<Index> numbers(const std::vector<GraphCount>& counts, Index GraphCount::*member) {
  std::vector<Index> values;
  for (const GraphCount& count : counts) values.push_back(count.*member);
  return values;
}

TEST(Topology, counts_components_and_loops_above_each_threshold) {
  const std::vector<GraphCount> counts =
      count_networks(two_triangles(), std::vector<double>{0.0, 1.0, 1.5, 2.5, 3.5, 4.0, 4.5});
  EXPECT_EQ(numbers(counts, &GraphCount::components), (std::vector<Index>{1, 1, 2, 2, 2, 2, 0}));
  EXPECT_EQ(numbers(counts, &GraphCount::loops), (std::vector<Index>{2, 2, 2, 1, 0, 0, 0}));
}

// Four grains in a row that goes around.
TEST(Topology, a_row_around_the_period_is_a_loop) {
  Packing packing = test::empty_packing(4.0, true);
  for (Index i = 0; i < 4; ++i) test::add_grain(packing, i + 0.5, 0.5);
  for (Index i = 0; i < 3; ++i) test::add_contact(packing, i, i + 1, 1.0);
  test::add_contact(packing, 0, 3, 1.0, 0.0, -1);
  const std::vector<GraphCount> counts = count_networks(packing, std::vector<double>{1.0});
  EXPECT_EQ(counts[0].components, 1);
  EXPECT_EQ(counts[0].loops, 1);
}

TEST(Topology, thresholds_are_of_the_mean_force) {
  const Packing packing = two_triangles();
  FrameRecord record;
  record.mean_normal_force = 2.0;
  take_topology(packing, std::vector<double>{0.5, 0.75, 2.0}, record);
  EXPECT_EQ(record.network_components, (std::vector<double>{1.0, 2.0, 2.0}));
  EXPECT_EQ(record.network_loops, (std::vector<double>{2.0, 2.0, 0.0}));
}

}  // namespace
}  // namespace talus
