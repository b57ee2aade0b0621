/// Ranges that fit the displacements and rotations of the grains. Maps of the difference between two frames.

#include <gtest/gtest.h>

#include <cmath>

#include "pictures/change_map.h"
#include "pictures/layers.h"
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
  analysis::GrainSource frame(bool per_degree) const {
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
  EXPECT_EQ(test::map_of(moved.now, settings).legends[0].bars[0].title, "speed (√(gD))");
  settings.motion = ranges;
  const Bar bar = test::map_of(moved.now, settings).legends[0].bars[0];
  EXPECT_EQ(bar.title, "speed (√(gD)), 5 to 99 % of grains");
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
  EXPECT_EQ(title("displacement", true, false), "displacement (D), 5 to 99 % of grains");
  EXPECT_EQ(title("displacement", false, false), "displacement (D)");
  EXPECT_EQ(title("displacement", true, true), "displacement (D)");
  EXPECT_EQ(title("rotation", true, false), "rotation (°), counter-clockwise positive, 95 % of grains");
  EXPECT_EQ(title("rotation", false, false), "rotation (°), counter-clockwise positive");
}

using test::extent_of, test::Packing, test::row_of_grains, test::settings_of;

/// Three adjacent grains in a periodic bed of 3 D: the frame at 7 deg, and its reference at 5 deg.
struct ChangedBed {
  Packing now, before;

  ChangedBed(const std::vector<double>& gamma_now, const std::vector<double>& gamma_before)
      : now(row_of_grains(gamma_now, true)), before(row_of_grains(gamma_before, true)) {
    now.frame.tilt = radians(7.0);
    before.frame.tilt = radians(5.0);
  }
  analysis::GrainSource frame() const { return {{now.frame, now.statics}, &before.frame, false}; }
  FrameView map(const std::string& layers) const {
    return pictures::make_change_map(frame(), settings_of(layers), extent_of(now));
  }
};

TEST(ChangeMap, IsTheDifferenceOnAScaleAboutZero) {
  const ChangedBed changed({0.5, 0.2, 0.3}, {0.3, 0.4, 0.3});
  const auto layers = pictures::change_layers(changed.frame(), settings_of("gamma"), extent_of(changed.now));
  ASSERT_EQ(layers.size(), 2u);
  ASSERT_EQ(layers[0].values.size(), 3u);
  EXPECT_NEAR(layers[0].values[0], 0.2, 1e-12);
  EXPECT_NEAR(layers[0].values[1], -0.2, 1e-12);
  EXPECT_EQ(layers[0].values[2], 0.0);
  EXPECT_NEAR(layers[0].scale->high, 0.5 * (1.0 - 0.05), 1e-12) << "half of that of gamma";
  EXPECT_EQ(layers[0].scale->low, -layers[0].scale->high);
  const FrameView view = changed.map("gamma");
  EXPECT_TRUE(view.coloured);
  EXPECT_EQ(view.title,
            "Change of stress ratio γ of single grains, 7.00° minus 5.00°; contacts gained and lost");
  EXPECT_EQ(view.discs[2].fill, colour_at(ColourMap::diverging, 0.5));
  EXPECT_GT(view.discs[0].fill.red, view.discs[0].fill.blue) << "orange if it increases";
  EXPECT_LT(view.discs[1].fill.red, view.discs[1].fill.blue) << "blue if it decreases";
}

TEST(ChangeMap, GrainsThatHaveNoValueInOneFrameAreOutlines) {
  const ChangedBed changed({0.5, std::nan(""), 0.3}, {std::nan(""), 0.4, 0.3});
  const FrameView view = changed.map("gamma");
  EXPECT_EQ(view.discs[0].fill, white);
  EXPECT_EQ(view.discs[1].fill, white);
}

TEST(ChangeMap, ARangeThatIsChosenForTheMapIsNotThatOfItsChange) {
  const ChangedBed changed({0.5, 0.2, 0.3}, {0.3, 0.4, 0.3});
  pictures::MapSettings settings = settings_of("gamma");
  settings.range_low = 0.0;
  settings.range_high = 0.1;
  settings.colours = ColourMap::viridis;
  EXPECT_EQ(pictures::make_change_map(changed.frame(), settings, extent_of(changed.now)).discs[0].fill,
            changed.map("gamma").discs[0].fill);
}

TEST(ChangeMap, OfALogarithmicMapIsInPowersOfTen) {
  ChangedBed changed({0.1, 0.1, 0.1}, {0.1, 0.1, 0.1});
  changed.before.frame.vx = {0.01, 0.01, 0.0};
  changed.now.frame.vx = {1.0, 0.001, 1.0};
  const auto layers = pictures::change_layers(changed.frame(), settings_of("speed"), extent_of(changed.now));
  EXPECT_NEAR(layers[0].values[0], 2.0, 1e-12);
  EXPECT_NEAR(layers[0].values[1], -1.0, 1e-12);
  EXPECT_TRUE(std::isnan(layers[0].values[2])) << "from rest";
  EXPECT_EQ(layers[0].legend.bars.at(0).title, "change (powers of ten)");
}

TEST(ChangeMap, WhereAMapGivesNoNumbersGrainsHaveMoved) {
  EXPECT_EQ(pictures::changing_kind(pictures::map_layers("gamma+forces")), pictures::MapKind::gamma);
  EXPECT_EQ(pictures::changing_kind(pictures::map_layers("forces+coarse")), pictures::MapKind::coarse);
  EXPECT_EQ(pictures::changing_kind(pictures::map_layers("clusters")), pictures::MapKind::gamma);
  EXPECT_EQ(pictures::changing_kind(pictures::map_layers("forces")), pictures::MapKind::displacement);
  EXPECT_EQ(pictures::changing_kind(pictures::map_layers("rotation")), pictures::MapKind::rotation);
  ChangedBed changed({0.1, 0.1, 0.1}, {0.1, 0.1, 0.1});
  changed.now.frame.x[1] += 0.25;
  const auto layers = pictures::change_layers(changed.frame(), settings_of("forces"), extent_of(changed.now));
  EXPECT_EQ(layers[0].values, (std::vector<double>{0.0, 0.25, 0.0})) << "total, not per degree";
}

TEST(ChangeMap, EveryMapHasAChange) {
  ChangedBed changed({0.1, 0.2, 0.3}, {0.3, 0.2, 0.1});
  for (Packing* packing : {&changed.now, &changed.before}) {
    packing->frame.internal_moment.assign(3, {1.0, 0.0, 0.0, 1.0});
    packing->statics.depth = 1.0;
  }
  for (const pictures::MapKind kind : pictures::map_kinds()) {
    pictures::MapSettings settings = settings_of(std::string(pictures::map_name(kind)));
    settings.length = 2.0;
    const auto layers = pictures::change_layers(changed.frame(), settings, extent_of(changed.now));
    EXPECT_EQ(layers[0].values.size(), 3u) << pictures::map_name(kind);
  }
}

TEST(ChangeMap, GainedContactsAreWholeLinesAndLostOnesStubs) {
  ChangedBed changed({0.1, 0.1, 0.1}, {0.1, 0.1, 0.1});
  test::add_contact(changed.before, 0, 1, 1.0);
  test::add_contact(changed.now, 1, 2, 1.0);
  changed.now.frame.x[0] -= 0.25;
  const auto layers = pictures::change_layers(changed.frame(), settings_of("gamma"), extent_of(changed.now));
  const std::vector<Line>& lines = layers[1].lines;
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_FLOAT_EQ(lines[0].x0, 0.25f);
  EXPECT_FLOAT_EQ(lines[0].x1, 0.75f) << "up to its edge";
  EXPECT_FLOAT_EQ(lines[1].x0, 1.5f);
  EXPECT_FLOAT_EQ(lines[1].x1, 1.0f);
  EXPECT_FLOAT_EQ(lines[2].x0, 1.5f);
  EXPECT_FLOAT_EQ(lines[2].x1, 2.5f);
  EXPECT_EQ(lines[0].colour, lines[1].colour);
  EXPECT_NE(lines[0].colour, lines[2].colour);
  const std::vector<Swatch>& swatches = layers[1].legend.swatches;
  EXPECT_EQ(swatches.at(0).label, "contacts gained: 1");
  EXPECT_EQ(swatches.at(0).fill, lines[2].colour);
  EXPECT_EQ(swatches.at(1).label, "lost: 1");
}

TEST(ChangeMap, ALostContactPointsToTheImageThatItWasWithThroughTheEdgeThatItsGrainHasLeftThrough) {
  // Grain 2 is to the left of grain 0, or to its right in the same image; grain 0 leaves on the left.
  for (const auto& [shift, end] : {std::pair(-1, 2.4f), {0, 3.4f}}) {
    ChangedBed changed({0.1, 0.1, 0.1}, {0.1, 0.1, 0.1});
    test::add_contact(changed.before, 0, 2, 1.0, 0.0, shift);
    changed.now.frame.x[0] = 2.9;
    changed.now.frame.image[0] = -1;
    changed.now.frame.x[2] = 2.0;
    const auto layers =
        pictures::change_layers(changed.frame(), settings_of("gamma"), extent_of(changed.now));
    ASSERT_EQ(layers[1].lines.size(), 2u);
    EXPECT_FLOAT_EQ(layers[1].lines[0].x0, 2.9f);
    EXPECT_FLOAT_EQ(layers[1].lines[0].x1, end);
  }
}

TEST(ChangeMap, NothingHasChangedWithoutAReference) {
  const Packing packing = row_of_grains({0.1, 0.2, 0.3});
  const auto layers =
      pictures::change_layers({{packing.frame, packing.statics}}, settings_of("gamma"), extent_of(packing));
  EXPECT_EQ(layers[0].values, (std::vector<double>(3, 0.0)));
  EXPECT_TRUE(layers[1].lines.empty());
}

}  // namespace
}  // namespace talus::render
