#include "analysis/histogram.h"

#include <gtest/gtest.h>

#include <cmath>

namespace talus::analysis {
namespace {

TEST(Histogram, counts_between_its_edges) {
  Histogram histogram(0.0, 1.0, 4);
  for (double value : {0.0, 0.25, 0.3, 0.49, 0.5, 1.0}) histogram.add(value);
  EXPECT_EQ(histogram.weight, (std::vector<double>{1.0, 3.0, 1.0, 1.0}));
  EXPECT_EQ(histogram.outside, 0.0);
  EXPECT_EQ(histogram.centre(1), 0.375);
  for (double value : {-0.1, 1.1, std::nan("")}) histogram.add(value);
  EXPECT_EQ(histogram.outside, 2.0);
  EXPECT_EQ(histogram.total, 8.0);
}

TEST(Histogram, density_has_the_integral_one) {
  Histogram histogram(logarithmic_edges(0.01, 10.0, 6));
  EXPECT_NEAR(histogram.edges[2], 0.1, 1e-12);
  EXPECT_EQ(histogram.edges.back(), 10.0);
  for (int k = 1; k < 10; ++k) histogram.add(k, 0.5);
  double integral = 0.0;
  for (std::size_t bin = 0; bin < 6; ++bin) integral += histogram.density()[bin] * histogram.width(bin);
  EXPECT_NEAR(integral, 1.0, 1e-12);
  histogram.add(20.0, 4.5);
  integral = 0.0;
  for (std::size_t bin = 0; bin < 6; ++bin) integral += histogram.density()[bin] * histogram.width(bin);
  EXPECT_NEAR(integral, 0.5, 1e-12);
}

TEST(Histogram, error_is_that_of_counting) {
  Histogram histogram(0.0, 2.0, 2);
  for (int k = 0; k < 9; ++k) histogram.add(0.5, 2.0);
  for (int k = 0; k < 16; ++k) histogram.add(1.5, 2.0);
  EXPECT_NEAR(histogram.error()[0], histogram.density()[0] / 3.0, 1e-15);
  EXPECT_NEAR(histogram.error()[1], histogram.density()[1] / 4.0, 1e-15);
}

TEST(Histogram, of_nothing_is_zero) {
  const Histogram histogram(0.0, 1.0, 2);
  EXPECT_EQ(histogram.density(), (std::vector<double>{0.0, 0.0}));
  EXPECT_EQ(histogram.error(), (std::vector<double>{0.0, 0.0}));
}

}  // namespace
}  // namespace talus::analysis
