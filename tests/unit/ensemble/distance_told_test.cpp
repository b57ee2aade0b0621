/// The distance from failure that measures of a bed tell, on measures with a known answer.

#include "ensemble/distance_told.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/random.h"

namespace talus {
namespace {

const std::vector<double> distances = {1.0, 2.0, 3.0, 4.0};

/// Nearly normal, of deviation 1.
double noise(Random& random) {
  double sum = -6.0;
  for (int k = 0; k < 12; ++k) sum += random.uniform();
  return sum;
}

/// A measure that is `slope` times the distance, plus `offset(bed)`, plus independent noise.
template <typename Offset>
BedCurves curves(std::size_t beds, double slope, double noise_size, Offset offset) {
  Random random(7);
  BedCurves measure;
  for (std::size_t bed = 0; bed < beds; ++bed) {
    std::vector<double>& curve = measure.emplace_back();
    for (const double distance : distances)
      curve.push_back(slope * distance + offset(bed) + noise_size * noise(random));
  }
  return measure;
}

double rms(const DistanceTold& told) { return root_mean_square(told.mean_square).value; }

/// By the definition itself, for one bed of six.
TEST(DistanceTold, IsTheMeanOfTheDistanceAfterTheMeasureIsKnown) {
  BedCurves measure = curves(6, 1.0, 0.6, [](std::size_t bed) { return 0.1 * static_cast<double>(bed % 3); });
  const DistanceTold told = distance_told(distances, measure);
  const std::size_t bed = 2;
  double mean_square = 0.0;
  for (std::size_t at = 0; at < distances.size(); ++at) {
    double weights = 0.0, sum = 0.0;
    for (std::size_t k = 0; k < distances.size(); ++k) {
      double mean = 0.0, square = 0.0;
      for (std::size_t other = 0; other < 6; ++other)
        if (other != bed) mean += measure[other][k] / 5.0;
      for (std::size_t other = 0; other < 6; ++other)
        if (other != bed) square += std::pow(measure[other][k] - mean, 2) / 4.0;
      const double weight =
          std::exp(-0.5 * std::pow(measure[bed][at] - mean, 2) / square) / std::sqrt(square);
      weights += weight;
      sum += weight * distances[k];
    }
    mean_square += 0.25 * std::pow(sum / weights - distances[at], 2);
  }
  EXPECT_NEAR(told.mean_square[bed], mean_square, 1e-12);
  EXPECT_EQ(told.beds, 6u);
}

TEST(DistanceTold, OfAMeasureThatSaysNothingIsTheMiddle) {
  const DistanceTold told = distance_told(distances, curves(200, 0.0, 1.0, [](std::size_t) { return 0.0; }));
  EXPECT_NEAR(rms(told), std::sqrt(1.25), 0.02) << "the deviation of 1, 2, 3, 4";
  EXPECT_NEAR(told.error[0], 1.5, 0.1);
  EXPECT_NEAR(told.error[1], 0.5, 0.1);
}

TEST(DistanceTold, OfAMeasureThatGoesWithItIsExact) {
  EXPECT_LT(rms(distance_told(distances, curves(20, 1.0, 0.01, [](std::size_t) { return 5.0; }))), 1e-6);
}

TEST(DistanceTold, ByTwoMeasuresWhoseErrorsCancelIsExact) {
  const auto offset = [](std::size_t bed) { return 1.5 * std::sin(static_cast<double>(bed * bed)); };
  const BedCurves up = curves(40, 1.0, 0.05, offset);
  const BedCurves down = curves(40, 1.0, 0.05, [&](std::size_t bed) { return -offset(bed); });
  const double alone = rms(distance_told(distances, up));
  EXPECT_GT(alone, 0.6);
  EXPECT_LT(rms(distance_told(distances, up, down)), 0.1);
  EXPECT_NEAR(rms(distance_told(distances, up, up)), alone, 0.03) << "the same twice says no more";
}

TEST(DistanceTold, DoesNotDependOnTheUnitOfAMeasure) {
  const BedCurves measure = curves(12, 1.0, 0.7, [](std::size_t) { return 0.0; });
  BedCurves scaled = measure;
  for (std::vector<double>& curve : scaled)
    for (double& value : curve) value = 1e-7 * value + 3e-7;
  EXPECT_NEAR(rms(distance_told(distances, scaled)), rms(distance_told(distances, measure)), 1e-9);
}

TEST(DistanceTold, LeavesOutBedsWithoutTheMeasure) {
  BedCurves measure = curves(8, 1.0, 0.3, [](std::size_t) { return 0.0; });
  measure[3].assign(distances.size(), std::nan(""));
  measure[4][0] = std::nan("");
  const DistanceTold told = distance_told(distances, measure);
  EXPECT_EQ(told.beds, 7u);
  EXPECT_TRUE(std::isnan(told.mean_square[3]));
  EXPECT_FALSE(std::isnan(told.mean_square[4])) << "three distances are left";
}

TEST(DistanceTold, NeedsBedsToCalibrateAndAMeasureThatVaries) {
  const auto none = [](std::size_t) { return 0.0; };
  EXPECT_EQ(distance_told(distances, curves(fewest_to_calibrate, 1.0, 0.3, none)).beds, 0u);
  EXPECT_EQ(distance_told(distances, curves(fewest_to_calibrate + 1, 1.0, 0.3, none)).beds,
            fewest_to_calibrate + 1);
  const DistanceTold constant = distance_told(distances, curves(9, 0.0, 0.0, none));
  EXPECT_EQ(constant.beds, 0u);
  EXPECT_TRUE(std::isnan(constant.error[0]));
}

/// A count that is zero far away and two or three at failure: the zeros say that it is far away.
TEST(DistanceTold, TakesACountThatIsStillZeroForFarAway) {
  BedCurves measure;
  for (std::size_t bed = 0; bed < 10; ++bed) measure.push_back({bed % 2 == 0 ? 3.0 : 2.0, 0.0, 0.0, 0.0});
  const DistanceTold told = distance_told(distances, measure);
  EXPECT_NEAR(told.error[0], 0.0, 1e-6);
  EXPECT_NEAR(told.error[2], 0.0, 1e-6) << "3 is the middle of 2, 3, 4";
  EXPECT_NEAR(told.error[3], 1.0, 1e-6);
}

TEST(RootMeanSquare, HasTheErrorOfItsMean) {
  const std::array<double, 3> squares = {1.0, 4.0, std::nan("")};
  const RootMeanSquare found = root_mean_square(squares);
  EXPECT_NEAR(found.value, std::sqrt(2.5), 1e-15);
  EXPECT_NEAR(found.error, 0.5 * 1.5 / std::sqrt(2.5), 1e-15) << "standard error of the mean square: 1.5";
  EXPECT_TRUE(std::isnan(root_mean_square({squares.data(), 1}).value));
}

}  // namespace
}  // namespace talus
