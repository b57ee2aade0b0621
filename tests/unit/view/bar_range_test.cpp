/// Range of a bar that is dragged.

#include <gtest/gtest.h>

#include "view/view_state.h"

namespace talus::view {
namespace {

using Part = HeldBar::Part;

TEST(BarRange, an_end_follows_and_the_other_stays) {
  const HeldBar low{Part::low, {0.05, 0.65, false}, 0.0}, high{Part::high, {0.05, 0.65, false}, 0.0};
  EXPECT_EQ(pulled(low, 0.5), (std::array{0.35, 0.65}));
  EXPECT_EQ(pulled(low, -0.5), (std::array{-0.25, 0.65})) << "wider when pulled outwards";
  EXPECT_EQ(pulled(high, 0.5), (std::array{0.05, 0.95}));
  EXPECT_EQ(pulled(high, 0.0), (std::array{0.05, 0.65})) << "neither moved nor rounded";
}

TEST(BarRange, the_middle_moves_both) {
  const HeldBar held{Part::middle, {0.0, 2.0, false}, 0.0};
  EXPECT_EQ(pulled(held, 0.25), (std::array{-0.5, 1.5})) << "the colours follow the mouse";
}

TEST(BarRange, the_ends_stay_apart) {
  const HeldBar low{Part::low, {0.0, 1.0, false}, 0.0}, high{Part::high, {0.0, 1.0, false}, 0.0};
  EXPECT_LT(pulled(low, 3.0)[0], 1.0);
  EXPECT_GT(pulled(high, -3.0)[1], 0.0);
}

TEST(BarRange, decades_are_pulled_as_decades) {
  const HeldBar held{Part::low, {1e-4, 1.0, true}, 0.0};
  EXPECT_EQ(pulled(held, 0.25)[0], 1e-3);
  EXPECT_EQ(pulled(held, -0.25)[0], 1e-5);
  EXPECT_GT(pulled(held, 5.0)[0], 0.0);
  EXPECT_DOUBLE_EQ(value_at(held.before, 0.5), 0.01);
}

TEST(BarRange, ends_are_round) {
  const HeldBar held{Part::high, {0.0, 0.6618, false}, 0.0};
  EXPECT_EQ(pulled(held, 0.1234)[1], 0.743) << "0.74347: thousandths of a range below 1";
}

}  // namespace
}  // namespace talus::view
