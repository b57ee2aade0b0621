/// Colour maps and scales.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/errors.h"
#include "pictures/scale.h"
#include "render/colour.h"

namespace talus::render {
namespace {

std::vector<std::string> labels_between(double low, double high, int most) {
  std::vector<std::string> labels;
  for (const pictures::RoundTick& tick : pictures::round_ticks(low, high, most)) labels.push_back(tick.label);
  return labels;
}

TEST(RoundTicks, AreMultiplesOfOneTwoOrFive) {
  EXPECT_EQ(labels_between(0.0, 15.0, 8),
            (std::vector<std::string>{"0", "2", "4", "6", "8", "10", "12", "14"}));
  EXPECT_EQ(labels_between(-0.2, 0.1, 3), (std::vector<std::string>{"−0.2", "−0.1", "0.0", "0.1"}));
  EXPECT_EQ(labels_between(0.91, 0.94, 3), (std::vector<std::string>{"0.91", "0.92", "0.93", "0.94"}));
  EXPECT_EQ(labels_between(0.0, 120.0, 4), (std::vector<std::string>{"0", "50", "100"}));
  EXPECT_EQ(labels_between(3e-4, 1.1e-3, 4),
            (std::vector<std::string>{"0.0004", "0.0006", "0.0008", "0.0010"}));
}

TEST(RoundTicks, StepIsTheSmallestOfWhichSoManyFit) {
  for (const double width : {0.013, 0.7, 1.0, 3.0, 42.0, 999.0}) {
    const double step = pictures::round_step(width, 5);
    EXPECT_LE(width / step, 5.0 + 1e-6);
    EXPECT_GT(width / step, 1.9) << width;
    const double mantissa = step / std::pow(10.0, std::floor(std::log10(step) + 1e-9));
    EXPECT_TRUE(std::fabs(mantissa - 1) < 1e-9 || std::fabs(mantissa - 2) < 1e-9 ||
                std::fabs(mantissa - 5) < 1e-9)
        << step;
  }
}

TEST(Scale, IsLinearOrLogarithmic) {
  const pictures::Scale linear{ColourMap::gray, 2.0, 6.0};
  EXPECT_DOUBLE_EQ(pictures::share_of(linear, 3.0), 0.25);
  const pictures::Scale decades{ColourMap::gray, 0.01, 100.0, true};
  EXPECT_NEAR(pictures::share_of(decades, 0.1), 0.25, 1e-12);
  EXPECT_NEAR(pictures::share_of(decades, 100.0), 1.0, 1e-12);
}

TEST(Scale, BeyondItsEndsAsAtThem) {
  const pictures::Scale scale{ColourMap::viridis, 2.0, 6.0};
  EXPECT_EQ(pictures::grain_style(scale, 1.0).fill, colour_at(ColourMap::viridis, 0.0));
  EXPECT_EQ(pictures::grain_style(scale, 9.0).fill, colour_at(ColourMap::viridis, 1.0));
  const pictures::Scale decades{ColourMap::viridis, 0.01, 100.0, true};
  EXPECT_EQ(pictures::grain_style(decades, 0.0).fill, colour_at(ColourMap::viridis, 0.0));
}

TEST(Scale, GrainsWithoutValueLookAsTheLowerEndAndAreNotMarked) {
  const pictures::GrainStyle style = pictures::grain_style({ColourMap::viridis, 0.0, 1.0}, std::nan(""));
  EXPECT_EQ(style.fill, colour_at(ColourMap::viridis, 0.0));
  EXPECT_FALSE(style.marked);
  EXPECT_TRUE(pictures::grain_style({ColourMap::viridis, 0.0, 1.0}, 0.0).marked);
}

TEST(Rim, ShowsAWhiteGrainAndIsDarkerThanAColour) {
  EXPECT_EQ(pictures::rim_of(white), gray(0.45));
  EXPECT_EQ(pictures::rim_of(gray(0.3)), gray(0.45));
  EXPECT_EQ(pictures::rim_of(gray(0.8)), gray(0.8));
  const Colour yellow{240, 230, 40};
  EXPECT_LT(luma(pictures::rim_of(yellow)), 0.7 * luma(yellow));
  EXPECT_EQ(pictures::rim_of(black), black);
}

TEST(Rim, IsLighterThanADarkColour) {
  for (const ColourMap map : {ColourMap::viridis, ColourMap::inferno, ColourMap::plasma}) {
    const Colour dark = colour_at(map, 0.02);
    EXPECT_GT(luma(pictures::rim_of(dark)), luma(dark) + 40.0) << colour_map_name(map);
  }
}

TEST(Scale, TakesWhatWasChosen) {
  const pictures::Scale scale =
      pictures::chosen({ColourMap::gray, 0.0, 1.0}, {ColourMap::cividis, std::nullopt, 2.0});
  EXPECT_EQ(scale.colours, ColourMap::cividis);
  EXPECT_EQ(scale.low, 0.0);
  EXPECT_EQ(scale.high, 2.0);
  EXPECT_THROW(pictures::chosen(scale, {{}, 2.0, {}}), Error);
  EXPECT_THROW(pictures::chosen(scale, {{}, 3.0, {}}), Error);
  EXPECT_THROW(pictures::chosen(scale, {{}, {}, std::nan("")}), Error);
  EXPECT_THROW(pictures::chosen({ColourMap::gray, 0.1, 1.0, true}, {{}, 0.0, {}}), Error);
}

TEST(Bar, OfAScaleHasRoundNumbersOrDecadesWhereTheyAre) {
  const Bar bar = pictures::bar_of({ColourMap::gray, -10.0, 10.0}, "turned");
  EXPECT_EQ(bar.title, "turned");
  EXPECT_EQ(bar.colours, colour_ramp(ColourMap::gray));
  ASSERT_EQ(bar.ticks.size(), 5u);
  EXPECT_EQ(bar.ticks[1].label, "−5");
  EXPECT_DOUBLE_EQ(bar.ticks[1].share, 0.25);
  const Bar decades = pictures::bar_of({ColourMap::gray, 1e-3, 10.0, true}, "");
  ASSERT_EQ(decades.ticks.size(), 5u);
  EXPECT_EQ(decades.ticks[0].label, "0.001");
  EXPECT_EQ(decades.ticks[4].label, "10");
  EXPECT_NEAR(decades.ticks[1].share, 0.25, 1e-12);
  const Bar few = pictures::bar_of({ColourMap::gray, 0.03, 1.0, true}, "");
  ASSERT_EQ(few.ticks.size(), 5u) << "two decades are too few";
  EXPECT_EQ(few.ticks[0].label, "0.05");
  EXPECT_EQ(few.ticks[4].label, "1");
  const Bar many = pictures::bar_of({ColourMap::gray, 1e-12, 1e12, true}, "");
  ASSERT_EQ(many.ticks.size(), 9u) << "every third decade";
  EXPECT_EQ(many.ticks[0].label, "10⁻¹²");
  EXPECT_EQ(many.ticks[4].label, "10⁰") << "like the others";
  EXPECT_EQ(pictures::bar_of({ColourMap::gray, 2e-5, 1.1e-4, true}, "").ticks[0].label, "2·10⁻⁵");
  const Bar huge = pictures::bar_of({ColourMap::gray, -1e12, 1e12}, "");
  EXPECT_EQ(huge.ticks[0].label, "−1.0·10¹²");
  EXPECT_EQ(huge.ticks[1].label, "−0.5·10¹²");
  EXPECT_EQ(huge.ticks[2].label, "0");
  const Bar within = pictures::bar_of({ColourMap::gray, 2.0, 8.0, true}, "");
  EXPECT_GE(within.ticks.size(), 3u) << "contains no decade";
  for (const BarTick& tick : within.ticks)
    EXPECT_NEAR(tick.share, std::log(std::stod(tick.label) / 2.0) / std::log(4.0), 1e-9);
}

std::string text_of(const Colour& c) {
  return std::to_string(c.red) + " " + std::to_string(c.green) + " " + std::to_string(c.blue) + " " +
         std::to_string(c.alpha);
}

struct KnownColour {
  ColourMap map;
  double share;
  Colour colour;
};

/// Published values: viridis ends at #440154 and #fde725, with #21918c in the middle; cividis ends at (0, 34,
/// 78) and (254, 232, 56).
TEST(ColourMap, HasKnownColours) {
  for (const KnownColour& known : {KnownColour{ColourMap::gray, 0.0, white},
                                   {ColourMap::gray, 1.0, black},
                                   {ColourMap::gray, 0.25, gray(0.25)},
                                   {ColourMap::viridis, 0.0, {0x44, 0x01, 0x54}},
                                   {ColourMap::viridis, 127.0 / 255.0, {0x21, 0x91, 0x8c}},
                                   {ColourMap::viridis, 1.0, {0xfd, 0xe7, 0x25}},
                                   {ColourMap::cividis, 0.0, {0, 34, 78}},
                                   {ColourMap::cividis, 127.0 / 255.0, {124, 123, 120}},
                                   {ColourMap::cividis, 1.0, {254, 232, 56}},
                                   {ColourMap::magma, 0.0, {0, 0, 4}},
                                   {ColourMap::magma, 127.0 / 255.0, {181, 54, 122}},
                                   {ColourMap::magma, 1.0, {252, 253, 191}},
                                   {ColourMap::inferno, 127.0 / 255.0, {186, 54, 85}},
                                   {ColourMap::inferno, 1.0, {252, 255, 164}},
                                   {ColourMap::plasma, 0.0, {13, 8, 135}},
                                   {ColourMap::plasma, 127.0 / 255.0, {203, 70, 121}},
                                   {ColourMap::plasma, 1.0, {240, 249, 33}},
                                   {ColourMap::gray_r, 0.0, black},
                                   {ColourMap::plasma_r, 0.0, {240, 249, 33}},
                                   {ColourMap::diverging, 0.0, {24, 66, 125}},
                                   {ColourMap::diverging, 0.5, {247, 247, 247}},
                                   {ColourMap::diverging, 1.0, {201, 95, 20}}}) {
    const Colour colour = colour_at(known.map, known.share);
    for (auto [is, should] : {std::pair{colour.red, known.colour.red},
                              {colour.green, known.colour.green},
                              {colour.blue, known.colour.blue},
                              {colour.alpha, known.colour.alpha}})
      EXPECT_NEAR(is, should, 1) << colour_map_name(known.map) << " at " << known.share << ": "
                                 << text_of(colour);
  }
}

TEST(ColourMap, LumaOfTheOneSidedMapsRunsOneWay) {
  for (ColourMap map : {ColourMap::gray, ColourMap::viridis, ColourMap::cividis, ColourMap::magma,
                        ColourMap::inferno, ColourMap::plasma, ColourMap::viridis_r}) {
    const std::vector<Colour> ramp = colour_ramp(map);
    ASSERT_EQ(ramp.size(), 256u);
    const double sign = map == ColourMap::gray || is_reversed(map) ? -1.0 : 1.0;
    for (std::size_t k = 1; k < ramp.size(); ++k)
      EXPECT_GT(sign * (luma(ramp[k]) - luma(ramp[k - 1])), -0.5) << colour_map_name(map) << ", step " << k;
    EXPECT_GT(sign * (luma(ramp.back()) - luma(ramp.front())), 150.0) << colour_map_name(map);
  }
}

TEST(ColourMap, DivergingIsLightestInTheMiddleAndItsEndsDiffer) {
  const std::vector<Colour> ramp = colour_ramp(ColourMap::diverging);
  for (std::size_t k = 1; k <= 127; ++k) EXPECT_GT(luma(ramp[k]) - luma(ramp[k - 1]), 0.5) << k;
  for (std::size_t k = 129; k < ramp.size(); ++k) EXPECT_LT(luma(ramp[k]) - luma(ramp[k - 1]), -0.3) << k;
  EXPECT_GT(luma(ramp.back()) - luma(ramp.front()), 40.0);
  EXPECT_TRUE(is_gray(colour_at(ColourMap::diverging, 0.5)));
}

TEST(ColourMap, StaysAtItsEndsOutOfRange) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  for (ColourMap map : colour_maps()) {
    for (double below : {-0.001, -1e300, -inf, std::numeric_limits<double>::quiet_NaN()})
      EXPECT_EQ(colour_at(map, below), colour_at(map, 0.0)) << colour_map_name(map) << " at " << below;
    for (double above : {1.001, 1e300, inf})
      EXPECT_EQ(colour_at(map, above), colour_at(map, 1.0)) << colour_map_name(map) << " at " << above;
  }
}

TEST(ColourMap, IsFoundByItsName) {
  ASSERT_EQ(colour_maps().size(), 7u);
  for (ColourMap map : colour_maps()) {
    const std::string name(colour_map_name(map));
    EXPECT_EQ(colour_map(name), map);
    EXPECT_EQ(colour_map(name + "_r"), reversed(map));
  }
  for (const char* name : {"", "jet", "turbo", "Gray", "grays", "_r", "gray_r_r"})
    EXPECT_FALSE(colour_map(name)) << name;
}

TEST(ColourMap, ReversedRunsFromTheOtherEnd) {
  for (ColourMap map : colour_maps()) {
    EXPECT_FALSE(is_reversed(map));
    EXPECT_TRUE(is_reversed(reversed(map)));
    EXPECT_EQ(reversed(reversed(map)), map);
    EXPECT_EQ(one_way(reversed(map)), map);
    std::vector<Colour> ramp = colour_ramp(map);
    std::ranges::reverse(ramp);
    EXPECT_EQ(colour_ramp(reversed(map)), ramp) << colour_map_name(map);
  }
}

}  // namespace
}  // namespace talus::render
