/// Ranges that fit the displacements and rotations of the grains.

#include <gtest/gtest.h>

#include "pictures/motion.h"
#include "render/map_bed.h"

namespace talus::render {
namespace {

using test::Packing;
using test::row_of_grains;

/// Hundred grains, of which grain i has moved by i + 1 thousandths of D and turned by as many degrees,
/// alternately to the left and to the right.
struct MovedBed {
  MovedBed() : now(row_of_grains(std::vector<double>(100, 0.1))), before(now.frame) {
    for (Index i = 0; i < 100; ++i) {
      now.frame.x[i] += 0.001 * (i + 1);
      now.frame.angle[i] += radians(i % 2 == 0 ? i + 1.0 : -i - 1.0);
    }
    now.frame.tilt = radians(2.0);
    now.frame.step = before.step + 10;
  }
  pictures::MapFrame frame(bool per_degree) const {
    return {{now.frame, now.statics}, &before, per_degree, {}};
  }

  Packing now;
  Frame before;
};

TEST(LogHistogram, FindsQuantilesToTwoPercent) {
  pictures::LogHistogram histogram;
  EXPECT_EQ(histogram.quantile(0.5), 0.0) << "without any values";
  for (int k = 1; k <= 1000; ++k) histogram.add(1e-5 * k);
  for (const double share : {0.05, 0.5, 0.99}) {
    EXPECT_GE(histogram.quantile(share), 0.01 * share);
    EXPECT_LE(histogram.quantile(share), 0.01 * share * 1.024);
  }
  for (int k = 0; k < 1000; ++k) histogram.add(0.0);
  EXPECT_EQ(histogram.quantile(0.5), 0.0);
  EXPECT_GT(histogram.quantile(0.51), 0.0);
  histogram.add(1e300);
  EXPECT_GT(histogram.quantile(1.0), 1e8) << "beyond the last class";
}

TEST(MotionSample, RangesLeaveOutFewGrains) {
  const MovedBed moved;
  pictures::MotionSample sample({pictures::MapKind::displacement, pictures::MapKind::rotation});
  sample.add(moved.frame(false));
  const pictures::MotionRanges ranges = sample.ranges();
  ASSERT_TRUE(ranges.range(pictures::MapKind::displacement, false) &&
              ranges.range(pictures::MapKind::rotation, false));
  EXPECT_NEAR(ranges.range(pictures::MapKind::displacement, false)->low, 0.005, 0.0002);
  EXPECT_NEAR(ranges.range(pictures::MapKind::displacement, false)->high, 0.099, 0.002);
  EXPECT_NEAR(ranges.range(pictures::MapKind::rotation, false)->high, 95.0, 2.5);
  EXPECT_EQ(ranges.range(pictures::MapKind::rotation, false)->low,
            -ranges.range(pictures::MapKind::rotation, false)->high);
  EXPECT_FALSE(ranges.range(pictures::MapKind::displacement, true) ||
               ranges.range(pictures::MapKind::rotation, true))
      << "nothing was measured per degree";
}

TEST(MotionSample, PerDegreeIsApart) {
  const MovedBed moved;
  pictures::MotionSample sample({pictures::MapKind::displacement, pictures::MapKind::rotation});
  sample.add(moved.frame(true));
  const pictures::MotionRanges ranges = sample.ranges();
  ASSERT_TRUE(ranges.range(pictures::MapKind::displacement, true).has_value());
  EXPECT_NEAR(ranges.range(pictures::MapKind::displacement, true)->high, 0.0495, 0.001) << "over two degrees";
  EXPECT_FALSE(ranges.range(pictures::MapKind::displacement, false).has_value());
}

TEST(MotionSample, HasNoRangeWhereNothingMovedAndANarrowOneWhereAllMovedAlike) {
  MovedBed moved;
  pictures::MotionSample still({pictures::MapKind::displacement, pictures::MapKind::rotation});
  still.add({moved.now.frame, moved.now.statics, nullptr, false, {}});
  still.add({moved.before, moved.now.statics, &moved.before, false, {}});
  EXPECT_FALSE(still.ranges().range(pictures::MapKind::displacement, false) ||
               still.ranges().range(pictures::MapKind::rotation, false));
  for (Index i = 0; i < 100; ++i) moved.now.frame.x[i] = moved.before.x[i] + 0.4;
  pictures::MotionSample alike({pictures::MapKind::displacement});
  alike.add(moved.frame(false));
  EXPECT_NEAR(alike.ranges().range(pictures::MapKind::displacement, false)->high, 0.4, 0.015);
  EXPECT_NEAR(alike.ranges().range(pictures::MapKind::displacement, false)->low, 0.2, 0.01);
}

TEST(MotionSample, RangesOfVelocitiesNeedNoEarlierFrame) {
  MovedBed moved;
  for (Index i = 0; i < 100; ++i) moved.now.frame.vx[i] = std::pow(10.0, -6.0 + 0.04 * i) * std::sqrt(10.0);
  pictures::MotionSample sample({pictures::MapKind::speed, pictures::MapKind::displacement});
  sample.add({{moved.now.frame, moved.now.statics}, nullptr, true});
  const pictures::MotionRanges ranges = sample.ranges();
  ASSERT_TRUE(ranges.range(pictures::MapKind::speed, false).has_value());
  EXPECT_NEAR(std::log10(ranges.range(pictures::MapKind::speed, false)->low), -5.8, 0.05) << "in sqrt(g D)";
  EXPECT_NEAR(std::log10(ranges.range(pictures::MapKind::speed, false)->high), -2.08, 0.05);
  EXPECT_FALSE(ranges.range(pictures::MapKind::displacement, false) ||
               ranges.range(pictures::MapKind::displacement, true));
  pictures::MapSettings settings = test::settings_of("speed");
  EXPECT_EQ(test::map_of(moved.now, settings).legends[0].bars[0].title, "in √(gD)");
  settings.motion = ranges;
  const Bar bar = test::map_of(moved.now, settings).legends[0].bars[0];
  EXPECT_EQ(bar.title, "in √(gD), 5 to 99 % of grains");
  EXPECT_EQ(bar.high, ranges.range(pictures::MapKind::speed, false)->high);
}

TEST(MotionSample, RangesOfCoarseFieldsAreOfTheirLength) {
  Packing bed = test::triangular_lattice(20, 8, true);
  test::complete(bed);
  for (std::size_t i = 0; i < bed.frame.x.size(); ++i)
    bed.frame.vx[i] = 1e-6 * std::sin(37.0 * static_cast<double>(i));
  pictures::MapSettings settings = test::settings_of("temperature");
  settings.length = 6.0;
  for (const pictures::MapKind kind : {pictures::MapKind::temperature, pictures::MapKind::shear_rate}) {
    pictures::MotionSample sample({kind}, settings);
    sample.add({{bed.frame, bed.statics}});
    const std::optional<pictures::ScaleRange> range = sample.ranges().range(kind, false);
    ASSERT_TRUE(range.has_value());
    EXPECT_LT(range->high, pictures::fixed_motion_range(kind, false).low) << "slower than the fixed range";
    settings.layers = {kind};
    settings.motion = sample.ranges();
    EXPECT_EQ(test::map_of(bed, settings).legends[0].bars[0].high, range->high);
    EXPECT_TRUE(test::map_of(bed, settings).legends[0].bars[0].title.ends_with(", 5 to 99 % of grains"));
  }
}

TEST(MotionSample, BarSaysHowManyGrainsARangeHolds) {
  const MovedBed moved;
  pictures::MotionSample sample({pictures::MapKind::displacement, pictures::MapKind::rotation});
  sample.add(moved.frame(false));
  const auto title = [&](const char* map, bool fitted, bool chosen) {
    pictures::MapSettings settings = test::settings_of(map);
    if (fitted) settings.motion = sample.ranges();
    if (chosen) settings.range_low = 0.1, settings.range_high = 1.0;
    return test::map_of(moved.now, settings, &moved.before, false).legends[0].bars[0].title;
  };
  EXPECT_EQ(title("displacement", true, false), "in D, 5 to 99 % of grains");
  EXPECT_EQ(title("displacement", false, false), "in D");
  EXPECT_EQ(title("displacement", true, true), "in D");
  EXPECT_EQ(title("rotation", true, false), "in °, counter-clockwise positive, 95 % of grains");
  EXPECT_EQ(title("rotation", false, false), "in °, counter-clockwise positive");
}

}  // namespace
}  // namespace talus::render
