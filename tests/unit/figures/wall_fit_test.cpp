#include "figures/wall_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace talus::figures {
namespace {

TEST(WallFit, GivesTheCoefficientOfPointsOnTheLaw) {
  std::vector<WallPoint> points;
  for (const double length : {100.0, 150.0, 200.0, 250.0, 300.0})
    points.push_back({40.0 / length, wall_law(2.5, 40.0 / length)});
  const WallFit fit = fit_wall_law(points);
  EXPECT_NEAR(fit.k, 2.5, 1e-14);
  EXPECT_NEAR(fit.error, 0.0, 1e-14);
}

TEST(WallFit, TheLawHasThePapersValues) {
  EXPECT_NEAR(wall_law(2.5, 40.0 / 100.0), 0.667, 5e-4);
  EXPECT_NEAR(wall_law(2.5, 40.0 / 300.0), 0.889, 5e-4);
  EXPECT_EQ(wall_law(2.5, 0.0), 1.0);
}

/// x = 1, 2 with 1 - ratio = 1, 1: k / 3 = (1 + 2) / (1 + 4) = 0.6; residuals 0.4 and -0.2, so the variance
/// is 0.2 with one degree of freedom, and that of k / 3 is 0.2 / 5.
TEST(WallFit, HasTheErrorOfItsResiduals) {
  const std::vector<WallPoint> points = {{1.0, 0.0}, {2.0, 0.0}};
  const WallFit fit = fit_wall_law(points);
  EXPECT_NEAR(fit.k, 1.8, 1e-15);
  EXPECT_NEAR(fit.error, 3.0 * std::sqrt(0.2 / 5.0), 1e-15);
}

TEST(WallFit, OnePointHasNoErrorAndNoPointNoCoefficient) {
  const std::vector<WallPoint> one = {{0.4, 0.6}};
  EXPECT_NEAR(fit_wall_law(one).k, 3.0, 1e-15);
  EXPECT_TRUE(std::isnan(fit_wall_law(one).error));
  EXPECT_TRUE(std::isnan(fit_wall_law({}).k));
}

}  // namespace
}  // namespace talus::figures
