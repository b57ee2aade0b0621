/// Shear stress of a packing just before failure, relative to that of an infinite slope.

#include "analysis/failure/failure_ratio.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "core/trigonometry.h"

namespace talus::analysis {
namespace {

TEST(FailureRatio, is_of_the_last_rows_before_it) {
  std::vector<double> tilts, stresses;
  for (const double ratio : {9.0, 9.0, 0.4, 0.6, 0.8, 9.0}) {
    tilts.push_back(radians(19.0 + 0.25 * static_cast<double>(tilts.size())));
    stresses.push_back(ratio * sine(tilts.back()) / cosine(tilts.back()));
  }
  const FailureRatio found = failure_ratio(tilts, stresses, radians(20.1), radians(0.75));
  EXPECT_NEAR(found.mean, 0.6, 1e-12) << "19.5, 19.75 and 20 deg";
  EXPECT_NEAR(found.spread, 0.2, 1e-12);
  const double none = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(failure_ratio(tilts, stresses, none, radians(0.75)).mean))
      << "the slope has not failed";
}

TEST(FailureRatio, leaves_out_the_horizontal_bed) {
  EXPECT_NEAR(failure_ratio(std::vector{0.0, 0.1}, std::vector{0.0, std::tan(0.1)}, 0.2, 1.0).mean, 1.0,
              1e-12);
}

}  // namespace
}  // namespace talus::analysis
