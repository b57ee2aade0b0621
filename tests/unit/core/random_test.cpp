#include "core/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>

namespace talus {
namespace {

// O'Neill's output for seed 42 and the default stream: pcg-cpp, test-high/expected/check-pcg32_oneseq.out,
// first round: six numbers, then 65 coins (below 2), then 33 rolls of a die (below 6, plus 1).
TEST(Random, gives_the_published_pcg32_sequence) {
  Random random(42);
  for (std::uint32_t expected :
       {0xc2f57bd6u, 0x6b07c4a9u, 0x72b7b29bu, 0x44215383u, 0xf5af5eadu, 0x68beb632u})
    EXPECT_EQ(random.next(), expected);
  std::string coins;
  for (int i = 0; i < 65; ++i) coins += random.below(2) == 1 ? 'H' : 'T';
  EXPECT_EQ(coins, "THTHHHTTHHTTHTTHTHHHTHTTTHTTHTTHTTTHHTTTTTHHTTTHTTHTHHTHHHTTHTTTH");
  std::string rolls;
  for (int i = 0; i < 33; ++i) rolls += std::to_string(random.below(6) + 1);
  EXPECT_EQ(rolls, "413366513443225413331464661612366");
}

// Golden values: pairs of the sequence above in exact arithmetic. If they changed, every published seed would
// give a different bed.
TEST(Random, uniform_keeps_its_golden_sequence) {
  Random random(1);
  for (double expected :
       {0x1.50d4b5fdab08p-2, 0x1.da37531d5582p-6, 0x1.0197514a66cb8p-2, 0x1.f58f2795226c6p-2})
    EXPECT_EQ(random.uniform(), expected);
}

TEST(Random, uniform_stays_in_range_with_the_moments_of_a_uniform_law) {
  constexpr int count = 200'000;
  Random random(7);
  double sum = 0.0, square = 0.0, low = 1.0, high = 0.0;
  for (int i = 0; i < count; ++i) {
    const double u = random.uniform();
    low = std::min(low, u);
    high = std::max(high, u);
    sum += u;
    square += u * u;
  }
  EXPECT_GE(low, 0.0);
  EXPECT_LT(high, 1.0);
  EXPECT_LT(low, 1e-4);
  EXPECT_GT(high, 1.0 - 1e-4);
  const double sigma = std::sqrt(1.0 / 12.0 / count);  // standard deviation of the mean
  EXPECT_NEAR(sum / count, 0.5, 4.0 * sigma);
  EXPECT_NEAR(square / count, 1.0 / 3.0, 4.0 * std::sqrt(4.0 / 45.0 / count));
}

TEST(Random, uniform_of_an_interval_stays_inside) {
  Random random(3);
  for (int i = 0; i < 10'000; ++i) {
    const double diameter = random.uniform(0.8, 1.2);
    EXPECT_GE(diameter, 0.8);
    EXPECT_LT(diameter, 1.2);
  }
}

TEST(Random, below_hits_each_value_equally_often) {
  constexpr std::uint32_t bound = 7;
  constexpr int count = 70'000;
  std::array<int, bound> hits{};
  Random random(11);
  for (int i = 0; i < count; ++i) ++hits.at(random.below(bound));
  const double sigma = std::sqrt(count * (1.0 / bound) * (1.0 - 1.0 / bound));
  for (int hit : hits) EXPECT_NEAR(hit, count / bound, 4.0 * sigma);
}

// For a bound of 3/4 of 2^32, a plain remainder would put half of all draws into the lowest third.
TEST(Random, below_is_without_bias_for_a_large_bound) {
  constexpr std::uint32_t third = 1u << 30;
  constexpr int count = 10'000;
  Random random(13);
  int low = 0;
  for (int i = 0; i < count; ++i) low += random.below(3 * third) < third ? 1 : 0;
  EXPECT_NEAR(low, count / 3.0, 4.0 * std::sqrt(count * 2.0 / 9.0));
}

TEST(Random, a_copy_forks_the_stream_and_seeds_differ) {
  Random first(5);
  Random copy = first;
  EXPECT_EQ(first.next(), copy.next());
  EXPECT_NE(Random(5).next(), Random(6).next());
}

}  // namespace
}  // namespace talus
