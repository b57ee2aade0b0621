#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/errors.h"
#include "render/map_bed.h"

namespace talus::render {
namespace {

using test::gamma_shade;
using test::map_of;
using test::Packing;
using test::row_of_grains;
using test::settings_of;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
const double gamma_c = sine(radians(30.0));

/// Returns one free grain of radius 0.5 at (x, 5) in a periodic bed of length 10.
Packing one_grain(double x) {
  Packing packing = test::empty_packing(10.0, true);
  test::add_grain(packing, x, 5.0);
  test::complete(packing);
  return packing;
}

FrameView part_of(const Packing& packing, const pictures::MapExtent& extent,
                  const std::string& layers = "gamma") {
  return pictures::make_map({{packing.frame, packing.statics}}, settings_of(layers), extent);
}

TEST(GammaMap, IsWhiteBelowTheRangeBlackAboveAndLinearBetween) {
  const std::vector<double> gamma = {0.0, 0.04, 0.3, 0.5, 0.9, 1.0, 1.2, nan};
  const FrameView view = map_of(row_of_grains(gamma), "gamma");
  ASSERT_EQ(view.discs.size(), gamma.size());
  for (std::size_t i = 0; i < gamma.size(); ++i) {
    const double shade = gamma_shade(gamma[i], gamma_c);
    EXPECT_EQ(view.discs[i].fill, gray(shade)) << gamma[i];
    EXPECT_EQ(view.discs[i].rim, gray(std::max(shade, 0.45))) << gamma[i];
  }
}

TEST(GammaMap, BarSaysWhatTheShadesMean) {
  Packing packing = row_of_grains({0.1, 0.2});
  packing.frame.tilt = radians(11.456);
  const FrameView view = map_of(packing, "gamma");
  ASSERT_EQ(view.legends.size(), 1u);
  const std::vector<BarTick>& ticks = view.legends[0].bars.at(0).ticks;
  ASSERT_EQ(ticks.size(), 3u);
  EXPECT_EQ(ticks[0].label, "0.05");
  EXPECT_EQ(ticks[1].label, "Γ_c = 0.50");
  EXPECT_EQ(ticks[2].label, "2Γ_c = 1.00");
  EXPECT_DOUBLE_EQ(ticks[1].share, gamma_shade(gamma_c, gamma_c));
  EXPECT_EQ(ticks[2].share, 1.0);
  EXPECT_EQ(view.caption, "θ = 11.46°, θ_c = 30.00°");
}

TEST(GammaMap, TakesGrainsWithTheirNeighboursAndSaysSo) {
  Packing packing = row_of_grains({1.0, 1.0, nan, nan, 0.4});
  packing.frame.internal_moment = {{1, 0, 0, 0}, {0, 0, 0, 1}, {0, 0, 0, 0}, {0, 0, 0, 0}, {0.7, 0, 0, 0.3}};
  pictures::MapSettings settings = settings_of("gamma+overloaded");
  settings.l_min = 2.5;
  packing.frame = pictures::mapped_frame(packing.frame, packing.statics, settings.l_min);
  const FrameView view = map_of(packing, settings);
  EXPECT_EQ(view.discs[0].fill, white)
      << "two grains loaded in perpendicular directions cancel their deviators";
  EXPECT_EQ(view.discs[2].fill, white) << "carries nothing, whatever its neighbour carries";
  EXPECT_EQ(view.discs[4].fill, gray(gamma_shade(0.4, gamma_c)));
  EXPECT_EQ(view.title,
            "Stress ratio γ of grains with their neighbours, l = 2.5 D; overloaded grains, l = 2.5 D, p_o = "
            "0.000");
}

TEST(GammaMap, TakesOtherColoursAndAnotherRange) {
  pictures::MapSettings settings = settings_of("gamma");
  settings.colours = ColourMap::viridis;
  settings.range_low = 0.2;
  settings.range_high = 0.8;
  const FrameView view = map_of(row_of_grains({0.35, nan}), settings);
  EXPECT_EQ(view.discs[0].fill, colour_at(ColourMap::viridis, 0.25));
  EXPECT_EQ(view.discs[1].fill, colour_at(ColourMap::viridis, 0.0));
  const Bar& bar = view.legends[0].bars[0];
  EXPECT_EQ(bar.colours, colour_ramp(ColourMap::viridis));
  EXPECT_EQ(bar.ticks.front().label, "0.2");
  EXPECT_EQ(bar.ticks.back().label, "0.8");
  EXPECT_NEAR(bar.ticks[1].share, 0.5, 1e-12);
}

TEST(OverloadedMap, IsBlackFromTheThresholdOn) {
  const std::vector<double> gamma = {gamma_c, std::nextafter(gamma_c, 0.0), nan, 0.75};
  const FrameView view = map_of(row_of_grains(gamma), "overloaded");
  EXPECT_EQ(view.discs[0].fill, black);
  EXPECT_EQ(view.discs[1].fill, white);
  EXPECT_EQ(view.discs[2].fill, white);
  EXPECT_EQ(view.title, "Overloaded single grains, p_o = 0.667");
  EXPECT_EQ(view.legends[0].swatches[0].label, "γ ≥ Γ_c = sin θ_c = 0.50");
  EXPECT_EQ(view.legends[0].swatches[1].label, "γ < Γ_c");

  pictures::MapSettings settings = settings_of("overloaded");
  settings.threshold_factor = 1.5;
  const FrameView higher = map_of(row_of_grains(gamma), settings);
  EXPECT_EQ(higher.discs[0].fill, white);
  EXPECT_EQ(higher.discs[3].fill, black);
  EXPECT_EQ(higher.legends[0].swatches[0].label, "γ ≥ 1.5Γ_c = 0.75");
}

TEST(OutlinedBed, HasOutlinesAndNoFurniture) {
  Packing packing = row_of_grains({0.1, 0.1, 0.1});
  test::add_floor_grain(packing, 0.5, -0.5);
  const FrameView view = pictures::outlined_bed({packing.frame, packing.statics}, {0.0, 3.0, -1.0, 2.0});
  ASSERT_EQ(view.discs.size(), 4u);
  EXPECT_EQ(view.discs[0].fill, white);
  EXPECT_EQ(view.discs[0].rim, gray(0.25));
  EXPECT_EQ(view.discs[2].hatched, 0.0f);
  EXPECT_EQ(view.discs[3].hatched, 1.0f);
  EXPECT_FALSE(view.furniture);
  EXPECT_EQ(view.x_max, 3.0);
  EXPECT_EQ(view.y_min, -1.0);
  EXPECT_EQ(view.y_max, 2.0);
}

TEST(Map, CopiesDiscsAcrossAPeriodicEdge) {
  EXPECT_EQ(map_of(one_grain(5.0), "gamma").discs.size(), 1u);
  const std::vector<Disc> left = map_of(one_grain(0.25), "gamma").discs;
  ASSERT_EQ(left.size(), 2u);
  EXPECT_FLOAT_EQ(left[1].x, 10.25f);
  EXPECT_EQ(left[1].fill, left[0].fill);
  const std::vector<Disc> right = map_of(one_grain(9.75), "gamma").discs;
  ASSERT_EQ(right.size(), 2u);
  EXPECT_FLOAT_EQ(right[1].x, -0.25f);

  Packing walls = one_grain(0.25);
  walls.statics.periodic = false;
  EXPECT_EQ(map_of(walls, "gamma").discs.size(), 1u);
}

TEST(Map, ShowsOnlyWhatReachesIntoItsExtent) {
  const Packing packing = row_of_grains(std::vector<double>(40, 0.3));
  const FrameView view = part_of(packing, {10.0, 20.0, -1.0, 3.0});
  EXPECT_EQ(view.discs.size(), 10u);
  EXPECT_EQ(part_of(packing, {10.2, 20.0, -1.0, 3.0}).discs.size(), 10u) << "a clipped grain is drawn";
  EXPECT_EQ(part_of(packing, {10.0, 20.0, 1.5, 3.0}).discs.size(), 0u);
  EXPECT_EQ(view.x_min, 10.0);
  EXPECT_EQ(view.x_max, 20.0);
  EXPECT_EQ(view.scale_label, "2 D");
  EXPECT_DOUBLE_EQ(view.scale_length, 2.0);
}

TEST(Map, WallsAndFloorAreDrawnWhereTheyAreSeen) {
  const Packing walls = row_of_grains(std::vector<double>(40, 0.3));
  const FrameView whole = map_of(walls, "gamma");
  EXPECT_TRUE(whole.left_wall && whole.right_wall && whole.floor_line);
  EXPECT_EQ(whole.scale_label, "10 D");
  const FrameView left = part_of(walls, {0.0, 10.0, 0.5, 3.0});
  EXPECT_TRUE(left.left_wall);
  EXPECT_FALSE(left.right_wall || left.floor_line);
  const FrameView right = part_of(walls, {30.0, 40.0, 0.0, 3.0});
  EXPECT_TRUE(right.right_wall && right.floor_line);
  EXPECT_FALSE(right.left_wall);
  const FrameView periodic = map_of(row_of_grains(std::vector<double>(40, 0.3), true), "gamma");
  EXPECT_FALSE(periodic.left_wall || periodic.right_wall);
}

TEST(Map, HatchesTheFloorAndShowsItWhole) {
  Packing packing = row_of_grains({0.1, 0.2, 0.3});
  for (double x : {0.5, 1.5, 2.5}) test::add_floor_grain(packing, x, -0.5);
  test::complete(packing);
  EXPECT_DOUBLE_EQ(test::extent_of(packing).y_min, -1.0);
  EXPECT_DOUBLE_EQ(test::extent_of(packing).y_max, 1.0);
  const FrameView view = map_of(packing, "gamma");
  EXPECT_FALSE(view.floor_line);
  int hatched = 0;
  for (const Disc& disc : view.discs)
    if (disc.hatched > 0.5f) {
      ++hatched;
      EXPECT_EQ(disc.rim, gray(0.75));
    }
  EXPECT_EQ(hatched, 3);
}

TEST(Map, RefusesAnAngleOfReposeThatGivesNoScale) {
  for (const std::string layers : {"gamma", "overloaded", "clusters", "coarse", "forces+gamma"})
    for (const double angle : {nan, 0.0, -0.3, 1.6}) {
      pictures::MapSettings settings = settings_of(layers);
      settings.theta_c = angle;
      EXPECT_THROW(map_of(row_of_grains({0.1, 0.2}), settings), Error) << layers << " " << angle;
    }
}

TEST(Map, CaptionSaysWhereThetaCIsAssumedAndNothingWhereThereIsNone) {
  const Packing packing = row_of_grains({0.1, 0.2});
  pictures::MapSettings settings = settings_of("gamma");
  settings.theta_c_assumed = true;
  EXPECT_EQ(map_of(packing, settings).caption, "θ = 0.00°, θ_c = 30.00° (assumed)");
  settings = settings_of("pressure");
  settings.theta_c = nan;
  EXPECT_EQ(map_of(packing, settings).caption, "θ = 0.00°");
}

TEST(Map, LettersHaveEightPointsInPrint) {
  pictures::MapSettings settings = settings_of("gamma");
  EXPECT_EQ(map_of(row_of_grains({0.1, 0.2}), settings).letters, FrameView().letters);
  settings.printed = 8.6;
  const double width = 8.6 / 2.54 * 72.0;  // points
  EXPECT_NEAR(width / map_of(row_of_grains({0.1, 0.2}), settings).letters, 8.0, 1e-9);
}

TEST(Map, IsTurnedToItsSlopeWhereAsked) {
  Packing packing = row_of_grains({0.1, 0.2});
  packing.frame.tilt = 0.2;
  pictures::MapSettings settings = settings_of("gamma");
  settings.tilt_max = 0.4;
  EXPECT_EQ(map_of(packing, settings).turn, 0.0);
  EXPECT_EQ(map_of(packing, settings).turn_max, 0.0);
  settings.turned = true;
  settings.transparent = true;
  settings.furniture = false;
  const FrameView view = map_of(packing, settings);
  EXPECT_EQ(view.turn, 0.2);
  EXPECT_EQ(view.turn_max, 0.4);
  EXPECT_EQ(view.tilt, 0.2);
  EXPECT_TRUE(view.transparent);
  EXPECT_FALSE(view.furniture);
}

TEST(TwoLayers, FillOverFillMarksTheInsideOfGrains) {
  const FrameView view = map_of(row_of_grains({0.2, 0.7}), "gamma+overloaded");
  ASSERT_EQ(view.discs.size(), 3u) << "only the overloaded grain is marked";
  EXPECT_EQ(view.discs[0].fill, gray(gamma_shade(0.2, gamma_c)));
  EXPECT_EQ(view.discs[1].fill, gray(gamma_shade(0.7, gamma_c)));
  EXPECT_EQ(view.discs[2].fill, black);
  EXPECT_FLOAT_EQ(view.discs[2].x, view.discs[1].x);
  EXPECT_FLOAT_EQ(view.discs[2].radius, 0.25f);
  EXPECT_EQ(view.legends.size(), 2u);
  EXPECT_EQ(view.title, "Stress ratio γ of single grains; overloaded single grains, p_o = 0.500");
}

TEST(TwoLayers, LinesAreDrawnOverFillsInEitherOrder) {
  Packing packing = row_of_grains({0.2, 0.7});
  test::add_contact(packing, 0, 1, 1.0, 0.5);
  for (const std::string layers : {"gamma+critical", "critical+gamma"}) {
    const FrameView view = map_of(packing, layers);
    ASSERT_EQ(view.discs.size(), 2u) << layers;
    EXPECT_EQ(view.discs[1].fill, gray(gamma_shade(0.7, gamma_c))) << layers;
    EXPECT_EQ(view.lines.size(), 2u) << layers << ": a line and its border";
    EXPECT_EQ(view.legends.size(), 2u) << layers;
  }
  EXPECT_EQ(map_of(packing, "forces+critical").lines.size(), 2u);
}

TEST(TwoLayers, ColoursAndRangeAreThoseOfTheFirstBar) {
  pictures::MapSettings settings = settings_of("overloaded+pressure");
  settings.colours = ColourMap::cividis;
  settings.range_high = 7.0;
  FrameView view = map_of(row_of_grains({0.2, 0.7}), settings);
  EXPECT_EQ(view.legends[1].bars[0].colours, colour_ramp(ColourMap::cividis));
  settings.layers = pictures::map_layers("pressure+rotation");
  view = map_of(row_of_grains({0.2, 0.7}), settings);
  EXPECT_EQ(view.legends[0].bars[0].colours, colour_ramp(ColourMap::cividis));
  EXPECT_EQ(view.legends[1].bars[0].colours, colour_ramp(ColourMap::diverging));
}

}  // namespace
}  // namespace talus::render
