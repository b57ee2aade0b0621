/// Figure of tilt cycles.

#include <gtest/gtest.h>

#include "figures/recipes.h"

namespace talus::figures {
namespace {

struct Ends {
  std::size_t first, top, last;
  bool is_closed;
  bool operator==(const Ends&) const = default;
};

std::vector<Ends> cycles(const std::vector<double>& tilts) {
  std::vector<Ends> found;
  for (const TiltCycle& cycle : cycles_of(tilts))
    found.push_back({cycle.first, cycle.top, cycle.last, cycle.is_closed});
  return found;
}

TEST(Cycles, go_from_where_the_tilt_begins_to_rise_to_where_it_does_so_again) {
  EXPECT_EQ(cycles({0, 1, 2, 1, 0, 1, 2, 1, 0}), (std::vector<Ends>{{0, 2, 4, true}, {4, 6, 8, true}}));
  EXPECT_EQ(cycles({0, 2, 0, 3}), (std::vector<Ends>{{0, 1, 2, true}, {2, 3, 3, false}}));
  EXPECT_EQ(cycles({0, 2, -2, 2, -2}), (std::vector<Ends>{{0, 1, 2, true}, {2, 3, 4, true}}));
}

TEST(Cycles, have_their_holds) {
  EXPECT_EQ(cycles({0, 0, 2, 2, 0, 0, 2}), (std::vector<Ends>{{0, 3, 5, true}, {5, 6, 6, false}}));
}

TEST(Cycles, of_a_tilt_that_only_rises_or_falls_or_stands_are_one) {
  EXPECT_EQ(cycles({0, 1, 1, 2}), (std::vector<Ends>{{0, 3, 3, false}}));
  EXPECT_EQ(cycles({0, -1, -2}), (std::vector<Ends>{{0, 0, 2, true}}));
  EXPECT_EQ(cycles({1, 1}), (std::vector<Ends>{{0, 1, 1, false}}));
  EXPECT_EQ(cycles({1}), (std::vector<Ends>{{0, 0, 0, false}}));
  EXPECT_TRUE(cycles({}).empty());
}

}  // namespace
}  // namespace talus::figures
