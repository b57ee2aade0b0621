/// Maps of stresses, motion and contacts, checked with hand-made packings.

#include <gtest/gtest.h>

#include <cmath>

#include "base/errors.h"
#include "render/map_bed.h"

namespace talus::render {
namespace {

using test::in_gray;
using test::map_of;
using test::Packing;
using test::row_of_grains;
using test::settings_of;

TEST(PressureMap, IsTheTraceOverTheAreaInUnitsOfRhoGD) {
  Packing packing = row_of_grains({0.1, 0.1});
  // rho g D = 2 * 10 * 1 = 20 Pa, the area pi / 4.
  packing.frame.internal_moment[0] = {30.0 * pi / 4.0, 7.0, 7.0, 50.0 * pi / 4.0};  // 80 Pa: 4
  const FrameView view = map_of(packing, in_gray("pressure", 0.0, 16.0));
  EXPECT_EQ(view.discs[0].fill, gray(0.25));
  EXPECT_EQ(view.discs[1].fill, white);
  EXPECT_EQ(view.legends[0].bars[0].title, "P = σ_1 + σ_2 (ρgD)");
}

TEST(PressureMap, RangeGoesByTheDepthOfTheBed) {
  Packing packing = row_of_grains({0.1, 0.1});
  packing.statics.depth = 40.0;
  EXPECT_EQ(map_of(packing, "pressure").legends[0].bars[0].ticks.back().label, "150");
  packing.statics.depth = 10.0;
  EXPECT_EQ(map_of(packing, "pressure").legends[0].bars[0].ticks.back().label, "30");
}

TEST(CoarseMap, SumsTheMomentsOfNeighbourhoods) {
  Packing packing = row_of_grains({1.0, 1.0, 1.0, 0.0, 0.0});
  // Two grains loaded in perpendicular directions cancel their deviators; the third is alone within 1 D.
  packing.frame.internal_moment = {{1, 0, 0, 0}, {0, 0, 0, 1}, {0, 0, 0, 0}, {0, 0, 0, 0}, {0.7, 0, 0, 0.3}};
  pictures::MapSettings settings = in_gray("coarse", 0.0, 1.0);
  settings.length = 2.5;
  const FrameView view = map_of(packing, settings);
  EXPECT_EQ(view.discs[0].fill, white);
  EXPECT_EQ(view.discs[2].fill, black) << "only the second grain is in reach and carries force";
  EXPECT_EQ(view.discs[4].fill, gray(0.4));
  EXPECT_EQ(view.title, "Stress ratio γ_l of neighbourhoods, l = 2.5 D");
  settings.length = 5.5;
  EXPECT_THROW(map_of(packing, settings), Error) << "longer than the bed";
  settings.length = 0.0;
  EXPECT_THROW(map_of(packing, settings), Error);
}

TEST(CoarseMap, IsWhiteAtZeroAndBlackAtOneAndAHalfGammaC) {
  Packing packing = row_of_grains({0.1, 0.1});
  packing.frame.internal_moment = {{0.75, 0, 0, 0.25}, {0.875, 0, 0, 0.125}};  // ratios 0.5, 0.75
  pictures::MapSettings settings = settings_of("coarse");
  settings.length = 1.0;
  const FrameView view = map_of(packing, settings);
  EXPECT_EQ(view.discs[0].fill, gray(0.5 / 0.75)) << "Gamma_c";
  EXPECT_EQ(view.discs[1].fill, black);
  const std::vector<BarTick>& ticks = view.legends[0].bars[0].ticks;
  ASSERT_EQ(ticks.size(), 3u);
  EXPECT_EQ(ticks[0].label, "0");
  EXPECT_EQ(ticks[1].label, "Γ_c = 0.50");
  EXPECT_EQ(ticks[2].label, "0.75");
}

/// A bed, and its state 2 degrees earlier.
struct MovedBed {
  Packing before, now;
};

/// Two grains in a periodic bed of length 2; the second has moved by (0.3, 0.4) D and turned by +20 deg, the
/// first has moved by 0.8 D through the right edge.
MovedBed moved_grains() {
  MovedBed moved{row_of_grains({0.1, 0.1}, true), row_of_grains({0.1, 0.1}, true)};
  moved.before.frame.x = {1.8, 1.0};
  moved.now.frame.x = {0.6, 1.3};
  moved.now.frame.image = {1, 0};
  moved.now.frame.y[1] += 0.4;
  moved.now.frame.angle[1] = radians(20.0);
  moved.now.frame.angle[0] = radians(-5.0);
  moved.before.frame.tilt = radians(5.0);
  moved.now.frame.tilt = radians(7.0);
  moved.now.frame.step = 100;
  return moved;
}

/// Returns the fills of the two grains, without images.
std::vector<Colour> fills_of(const FrameView& view) {
  std::vector<Colour> fills;
  for (const Disc& disc : view.discs)
    if (disc.x >= 0.0f && disc.x < 2.0f) fills.push_back(disc.fill);
  return fills;
}

TEST(DisplacementMap, IsUnrolledOverThePeriodAndLogarithmic) {
  const MovedBed moved = moved_grains();
  const pictures::MapSettings settings = in_gray("displacement", 0.1, 10.0);
  const FrameView since = map_of(moved.now, settings, &moved.before.frame, false);
  const auto shade = [](double value) { return gray(0.5 * std::log10(value / 0.1)); };
  EXPECT_EQ(fills_of(since), (std::vector<Colour>{shade(0.8), shade(0.5)}));
  EXPECT_EQ(since.title, "Displacement since 5.00°");
  const FrameView rate = map_of(moved.now, settings, &moved.before.frame, true);
  EXPECT_EQ(fills_of(rate), (std::vector<Colour>{shade(0.4), shade(0.25)})) << "over two degrees";
  EXPECT_EQ(rate.title, "Displacement per degree of tilt");
  EXPECT_EQ(rate.legends[0].bars[0].title, "displacement (D per degree)");
}

TEST(DisplacementMap, NothingHasMovedWithoutAReference) {
  const FrameView view = map_of(moved_grains().now, in_gray("displacement", 0.1, 10.0));
  EXPECT_EQ(fills_of(view), (std::vector<Colour>{white, white}));
  EXPECT_EQ(view.title, "Displacement per degree of tilt");
}

TEST(DisplacementMap, OfAFlowAtOneTiltIsNotOverDegrees) {
  MovedBed moved = moved_grains();
  moved.before.frame.tilt = moved.now.frame.tilt;
  const FrameView view = map_of(moved.now, in_gray("displacement", 0.1, 10.0), &moved.before.frame, true);
  EXPECT_EQ(fills_of(view)[1], gray(0.5 * std::log10(0.5 / 0.1)));
  EXPECT_EQ(view.title, "Displacement since 7.00°");
}

TEST(DisplacementArrows, PointWhereGrainsGoAndAreAsLongAsTheyMoved) {
  MovedBed moved = moved_grains();
  moved.now.frame.image[0] = 0;
  moved.now.frame.x[0] = moved.before.frame.x[0] = 0.4;
  moved.now.frame.y[0] = moved.before.frame.y[0] - 0.15;
  const FrameView view = pictures::make_map({moved.now.frame, moved.now.statics, &moved.before.frame, false},
                                            settings_of("gamma+displacement"), {0.0, 2.0, -2.0, 3.0});
  ASSERT_EQ(view.lines.size(), 12u) << "each with a border below all lines";
  const auto length = [](const Line& line) { return std::hypot(line.x1 - line.x0, line.y1 - line.y0); };
  const Line& down = view.lines[6];
  const Line& up = view.lines[9];
  EXPECT_FLOAT_EQ(down.x0, 0.4f);
  EXPECT_FLOAT_EQ(down.x1, 0.4f);
  EXPECT_LT(down.y1, down.y0);
  EXPECT_FLOAT_EQ(up.x0, 1.3f);
  EXPECT_NEAR((up.y1 - up.y0) / (up.x1 - up.x0), 4.0 / 3.0, 1e-5);
  EXPECT_NEAR(length(up), 2.0 * 0.5, 1e-5) << "D";
  EXPECT_NEAR(length(down), 2.0 * 0.15, 1e-5);
  EXPECT_FLOAT_EQ(view.lines[10].x0, up.x1) << "the head is at the tip";
  EXPECT_FLOAT_EQ(view.lines[11].y0, up.y1);
  EXPECT_EQ(view.legends[1].swatches[0].label, "arrow = 2 × displacement, at most 2 D");
  const FrameView rate = pictures::make_map({moved.now.frame, moved.now.statics, &moved.before.frame, true},
                                            settings_of("gamma+displacement"), {0.0, 2.0, -2.0, 3.0});
  EXPECT_EQ(rate.legends[1].swatches[0].label, "arrow = 5 × displacement per degree, at most 2 D");
  EXPECT_NEAR(length(rate.lines.back()), 0.41 * 5.0 * 0.5 / 2.0, 0.01)
      << "the head, for motion over two degrees";
}

/// One fast grain does not reduce the other arrows to dots, and its arrow does not cross the picture.
TEST(DisplacementArrows, GoByNearlyAllGrainsAndCutTheLongest) {
  Packing packing = row_of_grains(std::vector<double>(200, 0.1));
  Frame before = packing.frame;
  for (std::size_t i = 0; i < before.y.size(); ++i) before.y[i] -= i == 7 ? 3.0 : 0.00035 * (i + 1.0);
  const FrameView view = pictures::make_map({packing.frame, packing.statics, &before, false},
                                            settings_of("gamma+displacement"), {0.0, 50.0, -5.0, 5.0});
  const auto length_at = [&view](double x) {
    for (auto line = view.lines.rbegin(); line != view.lines.rend(); ++line)
      if (std::abs(line->x0 - x) < 1e-3 && std::abs(line->x1 - x) < 1e-6) return line->y1 - line->y0;
    return 0.0f;
  };
  EXPECT_NEAR(length_at(40.5), 20.0 * 41.0 * 0.00035, 1e-4);
  EXPECT_NEAR(length_at(30.5), 20.0 * 31.0 * 0.00035, 1e-4) << "shorter for a smaller displacement";
  EXPECT_FLOAT_EQ(length_at(7.5), 2.0f);
  EXPECT_FLOAT_EQ(length_at(0.5), 0.0f) << "too short to be visible";
}

/// A frame with little motion has short arrows in the common range of all pictures of a run.
TEST(DisplacementArrows, OfOneRangeCanBeCompared) {
  MovedBed moved = moved_grains();
  moved.now.frame.image[0] = 0;
  pictures::MapSettings settings = settings_of("gamma+displacement");
  settings.motion.fitting[pictures::MapKind::displacement] = {pictures::ScaleRange{0.01, 3.0},
                                                              pictures::ScaleRange{0.01, 3.0}};
  const FrameView view = pictures::make_map({moved.now.frame, moved.now.statics, &moved.before.frame, false},
                                            settings, {0.0, 2.0, -2.0, 3.0});
  EXPECT_EQ(view.legends[1].swatches[0].label, "arrow = 0.5 × displacement, at most 2 D");
}

TEST(DisplacementArrows, AreSpreadOverALongBed) {
  Packing packing = row_of_grains(std::vector<double>(600, 0.1));
  Frame before = packing.frame;
  for (double& x : before.x) x -= 0.1;
  const FrameView whole = map_of(packing, settings_of("gamma+displacement"), &before, false);
  EXPECT_NEAR(static_cast<double>(whole.lines.size()), 2.0 * 3.0 * 60.0, 12.0);
  const FrameView part = pictures::make_map({packing.frame, packing.statics, &before, false},
                                            settings_of("gamma+displacement"), {100.0, 140.0, 0.0, 2.0});
  EXPECT_GE(part.lines.size(), 2u * 3u * 40u) << "for each grain in a part of the bed";
}

TEST(RotationMap, IsWhiteAtZeroAndCounterClockwisePositive) {
  const MovedBed moved = moved_grains();
  pictures::MapSettings settings = settings_of("rotation");
  settings.range_low = -40.0;
  settings.range_high = 40.0;
  const FrameView view = map_of(moved.now, settings, &moved.before.frame, false);
  const auto colour = [](double share) { return colour_at(ColourMap::diverging, share); };
  EXPECT_EQ(fills_of(view), (std::vector<Colour>{colour(0.5 - 5.0 / 80.0), colour(0.5 + 20.0 / 80.0)}));
  EXPECT_EQ(view.title, "Rotation since 5.00°");
  const FrameView rate = map_of(moved.now, settings, &moved.before.frame, true);
  EXPECT_EQ(fills_of(rate)[1], colour(0.5 + 10.0 / 80.0));
  EXPECT_EQ(fills_of(map_of(moved.now, "rotation"))[1], colour(0.5));
}

/// Returns three grains between walls with forces 1, 2, 3 and 10, the last at the left wall, which is body 3
/// (there is no floor).
Packing chain() {
  Packing packing = row_of_grains({0.1, 0.1, 0.1});
  test::add_contact(packing, 0, 1, 3.0, 1.0);
  test::add_contact(packing, 1, 2, 1.0, 0.5);  // sliding, mu = 0.5
  test::add_left_wall_contact(packing, 0, 2.0);
  return packing;
}

TEST(ForcesMap, LinesAreAsWideAsForcesAreLargeTheStrongOnesAbove) {
  const FrameView view = map_of(chain(), "forces");
  EXPECT_EQ(view.discs[0].fill, white);
  ASSERT_EQ(view.lines.size(), 3u);
  const Line& weak = view.lines[0];  // force 1, below the mean of 2
  const Line& wall = view.lines[1];  // force 2, not above the mean
  const Line& strong = view.lines[2];
  EXPECT_FLOAT_EQ(weak.x0, 1.5f);
  EXPECT_FLOAT_EQ(weak.x1, 2.5f);
  EXPECT_FLOAT_EQ(strong.x0, 0.5f);
  EXPECT_FLOAT_EQ(strong.x1, 1.5f);
  EXPECT_FLOAT_EQ(wall.x0, 0.5f);
  EXPECT_FLOAT_EQ(wall.x1, 0.0f) << "to the contact point";
  EXPECT_FLOAT_EQ(wall.y1, 0.5f);
  EXPECT_FLOAT_EQ(strong.half_width, 3.0f * weak.half_width);
  EXPECT_GT(luma(weak.colour), luma(strong.colour) + 50.0);
  EXPECT_EQ(wall.colour, weak.colour);
}

/// Printed in gray, a line over filled grains is distinguishable from grains of any shade, by itself or by
/// its border.
TEST(LinesOverGrains, AreSeenOnAnyShadeOfGray) {
  for (const char* layers : {"gamma+forces", "pressure+critical", "clusters+forces", "rotation+forces"}) {
    SCOPED_TRACE(layers);
    Packing packing = chain();
    const FrameView view = map_of(packing, settings_of(layers));
    const auto first =
        std::ranges::find_if(view.lines, [](const Line& line) { return line.colour.alpha == 255; });
    const auto count = static_cast<std::size_t>(view.lines.end() - first);
    ASSERT_GT(count, 0u);
    ASSERT_EQ(count % 2, 0u);
    for (std::size_t k = 0; k < count / 2; ++k) {
      const Line &border = *(first + static_cast<std::ptrdiff_t>(k)),
                 &line = *(first + static_cast<std::ptrdiff_t>(k + count / 2));
      EXPECT_FLOAT_EQ(border.half_width, line.half_width + 0.06f);
      EXPECT_TRUE(border.x0 == line.x0 && border.y0 == line.y0 && border.x1 == line.x1 &&
                  border.y1 == line.y1);
      for (double shade = 0.0; shade <= 255.0; shade += 5.0)
        EXPECT_GT(std::max(std::abs(luma(line.colour) - shade), std::abs(luma(border.colour) - shade)), 60.0)
            << shade;
    }
  }
  for (const Line& line : map_of(chain(), "forces").lines)
    EXPECT_FALSE(line.colour == white) << "on outlines";
}

TEST(ForcesMap, NoLineIsWiderThanTheSmallestGrains) {
  Packing packing = row_of_grains(std::vector<double>(40, 0.1));
  for (Index i = 0; i + 1 < 40; ++i) test::add_contact(packing, i, i + 1, i == 0 ? 1000.0 : 1.0);
  double widest = 0.0;
  for (const Line& line : map_of(packing, "forces").lines) widest = std::max<double>(widest, line.half_width);
  EXPECT_LT(widest, 0.4) << "radius of the smallest, in D";
  EXPECT_GT(widest, 0.2);
}

TEST(ForcesMap, ContactsAcrossThePeriodicEdgeAreDrawnAtBothEnds) {
  Packing packing = row_of_grains({0.1, 0.1, 0.1}, true);
  test::add_contact(packing, 0, 2, 1.0, 0.0, -1);
  const FrameView view = map_of(packing, "forces");
  ASSERT_EQ(view.lines.size(), 2u);
  EXPECT_FLOAT_EQ(view.lines[0].x0, 0.5f);
  EXPECT_FLOAT_EQ(view.lines[0].x1, -0.5f);
  EXPECT_FLOAT_EQ(view.lines[1].x0, 3.5f);
  EXPECT_FLOAT_EQ(view.lines[1].x1, 2.5f);
}

TEST(ForcesMap, OfABedWithoutContactsHasNoLines) {
  EXPECT_TRUE(map_of(row_of_grains({0.1, std::nan("")}), "forces").lines.empty());
  EXPECT_EQ(map_of(row_of_grains({0.1, std::nan("")}), "critical").title, "Critical contacts");
}

TEST(CriticalMap, MarksContactsThatSlideAlongTheirSurfaces) {
  const FrameView view = map_of(chain(), "critical");
  ASSERT_EQ(view.lines.size(), 1u);
  const Line& line = view.lines[0];
  EXPECT_FLOAT_EQ(line.x0, 2.0f);
  EXPECT_FLOAT_EQ(line.x1, 2.0f);
  EXPECT_FLOAT_EQ(0.5f * (line.y0 + line.y1), 0.5f);
  EXPECT_GT(std::fabs(line.y1 - line.y0), 0.5f);
  EXPECT_EQ(view.title, "Critical contacts, 33.3 % of all");
  EXPECT_LT(luma(line.colour), 128.0);
}

TEST(Lines, OutsideOfTheExtentAreLeftOut) {
  const Packing packing = chain();
  const FrameView view =
      pictures::make_map({packing.frame, packing.statics}, settings_of("forces"), {1.8, 3.0, 0.0, 1.0});
  ASSERT_EQ(view.lines.size(), 1u);
  EXPECT_FLOAT_EQ(view.lines[0].x0, 1.5f);
}

}  // namespace
}  // namespace talus::render
