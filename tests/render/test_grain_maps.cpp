/// Maps of grain properties, of contacts, of local deformation, and of continuum fields, checked with
/// hand-made packings.

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

/// Expects a shade from 0 (white) to 1 (black), within one of 255 steps.
testing::AssertionResult is_shade(const Colour& fill, double shade) {
  const double found = 1.0 - luma(fill) / 255.0;
  if (std::fabs(found - shade) < 1.01 / 255.0) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "the shade is " << found << " instead of " << shade;
}

/// Returns the fill of a grain of a packing; the view of a periodic packing contains images.
Colour fill_of(const FrameView& view, const Packing& packing, std::size_t grain) {
  for (const Disc& disc : view.discs)
    if (disc.x == static_cast<float>(packing.frame.x[grain]) &&
        disc.y == static_cast<float>(packing.frame.y[grain]))
      return disc.fill;
  return {};
}

Colour viridis(double share) { return colour_at(ColourMap::viridis, share); }

TEST(SpeedMap, IsInTheSpeedOfAFallOverAGrainAndLogarithmic) {
  Packing packing = row_of_grains({0.1, 0.1});
  packing.frame.vx[0] = 0.3 * std::sqrt(10.0);
  packing.frame.vy[0] = -0.4 * std::sqrt(10.0);
  const FrameView view = map_of(packing, in_gray("speed", 0.005, 50.0));
  EXPECT_TRUE(is_shade(view.discs[0].fill, 0.5)) << "0.5 sqrt(g D)";
  EXPECT_EQ(view.discs[1].fill, white);
  EXPECT_EQ(view.legends[0].bars[0].title, "speed (√(gD))");
}

TEST(OwnMap, HasItsUnitInParentheses) {
  Packing packing = row_of_grains({0.1, 0.1});
  const auto title = [&](const char* unit) {
    packing.frame.own = {{{1.0, 2.0}, OwnQuantity::Kind::number, "push", unit}};
    pictures::MapSettings settings = settings_of("size");
    settings.own = packing.frame.own[0];
    return map_of(packing, settings).legends[0].bars[0].title;
  };
  EXPECT_EQ(title("m g"), "push (m g)");
  EXPECT_EQ(title(""), "push");
}

TEST(SizeMap, GoesFromTheSmallestToTheLargest) {
  Packing packing = row_of_grains({0.1, 0.1, 0.1});
  packing.statics.radius = {0.4, 0.5, 0.6};
  const FrameView view = map_of(packing, "size");
  EXPECT_EQ(view.discs[0].fill, viridis(0.0));
  EXPECT_EQ(view.discs[1].fill, viridis(0.5));
  EXPECT_EQ(view.discs[2].fill, viridis(1.0));
  EXPECT_EQ(map_of(row_of_grains({0.1, 0.1}), "size").discs[0].fill, viridis(0.5)) << "all of equal size";
}

/// Returns twenty-four grains on top of each other at each of two places.
Packing two_columns() {
  Packing packing = test::empty_packing(40.0, true);
  for (const double x : {5.0, 15.0})
    for (int k = 0; k < 24; ++k) test::add_grain(packing, x, 0.5 + k);
  test::complete(packing);
  return packing;
}

TEST(DyedMap, GrainsKeepTheColoursOfTheirLayerAndColumn) {
  Packing packing = two_columns();
  pictures::SeenFrames seen;
  for (std::size_t i = 0; i < packing.frame.x.size(); ++i)
    seen.begin.push_back({packing.frame.x[i], packing.frame.y[i]});
  const FrameView before = map_of(packing, "dyed");
  EXPECT_EQ(before.discs[0].fill, viridis(0.5 / 8.0));
  EXPECT_EQ(before.discs[2].fill, before.discs[0].fill) << "three grains in each of eight layers";
  EXPECT_EQ(before.discs[3].fill, viridis(1.5 / 8.0));
  EXPECT_EQ(before.discs[23].fill, viridis(7.5 / 8.0));
  EXPECT_LT(luma(before.discs[24].fill), luma(before.discs[0].fill)) << "the second column is darker";
  std::swap(packing.frame.y[0], packing.frame.y[23]);
  packing.frame.x[0] = 35.0;
  const analysis::GrainSource now{{packing.frame, packing.statics}};
  const FrameView after = pictures::make_map(now, settings_of("dyed"), test::extent_of(packing), &seen);
  for (std::size_t i = 0; i < 48; ++i) EXPECT_EQ(after.discs[i].fill, before.discs[i].fill) << i;
  seen.begin.pop_back();
  EXPECT_EQ(pictures::make_map(now, settings_of("dyed"), test::extent_of(packing), &seen).discs[47].fill,
            before.discs[47].fill)
      << "a grain that arrived later is at its current place";
}

/// Returns 0, 1 and 2 touching in a row, the first on a floor grain; 3 has no contact. Friction is 0.5.
Packing held() {
  Packing packing = row_of_grains({0.1, 0.1, 0.1, 0.1});
  const Index floor = test::add_floor_grain(packing, 0.5, -0.5);
  test::complete(packing);
  test::add_contact(packing, 0, 1, 1.0, 0.5);   // fully mobilised
  test::add_contact(packing, 1, 2, 2.0, -0.5);  // half mobilised
  test::add_contact(packing, 0, floor, 4.0, 0.0);
  return packing;
}

TEST(CoordinationMap, CountsContactsWithForce) {
  const FrameView view = map_of(held(), in_gray("coordination", 0.0, 4.0));
  EXPECT_TRUE(is_shade(view.discs[0].fill, 0.5));
  EXPECT_TRUE(is_shade(view.discs[1].fill, 0.5));
  EXPECT_TRUE(is_shade(view.discs[2].fill, 0.25));
  EXPECT_EQ(view.discs[3].fill, white);
  EXPECT_EQ(view.title, "Contacts of grains, z = 1.67");
}

TEST(MobilisedMap, IsTheMeanOverTheContactsOfAGrain) {
  const FrameView view = map_of(held(), "mobilised");
  EXPECT_EQ(view.discs[0].fill, viridis(0.5));
  EXPECT_EQ(view.discs[1].fill, viridis(0.75));
  EXPECT_EQ(view.discs[2].fill, viridis(0.5));
  EXPECT_EQ(view.discs[3].fill, white) << "without a contact";
}

TEST(RigidMap, TellsTheLargestClusterFromOthers) {
  Packing packing = row_of_grains(std::vector<double>(9, 0.1));
  for (const auto& [a, b] : {std::pair(0, 1), {1, 2}, {0, 2}, {2, 3}, {1, 3}, {5, 6}, {6, 7}, {5, 7}, {7, 8}})
    test::add_contact(packing, a, b, 1.0, 0.1);
  const FrameView view = map_of(packing, "rigid");
  const Colour largest = view.discs[0].fill, other = view.discs[5].fill;
  EXPECT_EQ(view.discs[3].fill, largest) << "two of the first three hold it";
  EXPECT_EQ(view.discs[4].fill, white);
  EXPECT_NE(largest, other);
  EXPECT_NE(other, white);
  EXPECT_EQ(view.discs[7].fill, other);
  EXPECT_EQ(view.discs[8].fill, white) << "it rolls on its only contact";
  EXPECT_EQ(view.title, "Rigid clusters, largest 44 %");
  EXPECT_EQ(view.legends[0].swatches[0].label, "largest");
  EXPECT_TRUE(view.coloured);
  EXPECT_EQ(map_of(row_of_grains({0.1, 0.1}), "rigid").title, "Rigid clusters, none");
}

/// A lattice, and its state 2 degrees earlier: it has been sheared by 0.1 since.
struct ShearedBed {
  ShearedBed() : now(test::triangular_lattice(12, 8, true)) {
    test::complete(now);
    before = now.frame;
    for (std::size_t i = 0; i < before.x.size(); ++i) now.frame.x[i] += 0.1 * now.frame.y[i];
    before.tilt = radians(5.0);
    now.frame.tilt = radians(7.0);
    now.frame.step = 100;
  }
  FrameView map(const pictures::MapSettings& settings, bool per_degree) const {
    return map_of(now, settings, &before, per_degree);
  }
  Packing now;
  Frame before;
};

TEST(StrainMaps, ShowTheDeformationOfNeighbourhoods) {
  const ShearedBed sheared;
  EXPECT_TRUE(is_shade(sheared.map(in_gray("shear", 0.01, 1.0), false).discs[40].fill, 0.5)) << "logarithmic";
  EXPECT_TRUE(is_shade(sheared.map(in_gray("shear", 0.005, 0.5), true).discs[40].fill, 0.5))
      << "over two degrees";
  EXPECT_TRUE(is_shade(sheared.map(in_gray("dilation", -0.1, 0.1), false).discs[40].fill, 0.5)) << "none";
  EXPECT_TRUE(is_shade(sheared.map(in_gray("vorticity", -0.2, 0.2), false).discs[40].fill, 0.25))
      << "clockwise";
  EXPECT_EQ(sheared.map(in_gray("nonaffine", 1e-4, 1.0), false).discs[40].fill, white);
  EXPECT_EQ(sheared.map(settings_of("shear"), true).title, "Shear strain per degree of tilt");
  EXPECT_EQ(sheared.map(settings_of("nonaffine"), false).title, "Non-affine displacement since 5.00°");
  EXPECT_EQ(sheared.map(settings_of("nonaffine"), true).legends[0].bars[0].title, "D_m_i_n (D per degree)");
  EXPECT_EQ(sheared.map(settings_of("vorticity"), true).legends[0].bars[0].title,
            "2 × turn (rad per degree), counter-clockwise positive");
  EXPECT_EQ(sheared.map(settings_of("dilation"), true).legends[0].bars[0].title,
            "ΔA/A of neighbourhoods (per degree)");
}

TEST(StrainMaps, NonaffineIsTheRootOfTheMeanSquareThatIsLeft) {
  ShearedBed sheared;
  sheared.now.frame.x[40] += 0.3;  // in the bulk: relative to it, all its neighbours have moved
  const pictures::MapSettings settings = in_gray("nonaffine", 0.03, 3.0);
  const FrameView view = sheared.map(settings, false);
  EXPECT_TRUE(is_shade(fill_of(view, sheared.now, 40), 0.5));
  EXPECT_LT(luma(fill_of(view, sheared.now, 40)), luma(fill_of(view, sheared.now, 41)));
}

TEST(CellsMap, IsWhiteAtTheSurface) {
  Packing packing = test::triangular_lattice(10, 8, true);
  test::complete(packing);
  const FrameView view = map_of(packing, in_gray("cells", 0.0, pi / std::sqrt(3.0)));
  EXPECT_TRUE(is_shade(fill_of(view, packing, 35), 0.5));
  EXPECT_EQ(fill_of(map_of(packing, "cells"), packing, 75), white);
}

TEST(FieldMaps, AreCoarseGrainedOverTheLengthAsked) {
  Packing packing = test::triangular_lattice(20, 16, true);
  test::complete(packing);
  for (std::size_t i = 0; i < packing.frame.x.size(); ++i)
    packing.frame.vx[i] = 0.2 * std::sqrt(10.0) * packing.frame.y[i];
  const auto middle = static_cast<std::size_t>(20 * 8 + 10);
  const auto shade = [&](const std::string& map, double low, double high) {
    pictures::MapSettings settings = in_gray(map, low, high);
    settings.length = 6.0;
    return luma(fill_of(map_of(packing, settings), packing, middle)) / 255.0;
  };
  EXPECT_NEAR(shade("density", 0.0, pi / std::sqrt(3.0)), 0.5, 0.02) << "pi / (2 sqrt 3)";
  EXPECT_NEAR(shade("shear_rate", 0.02, 2.0), 0.5, 0.02) << "0.2 sqrt(g / D)";
  EXPECT_EQ(shade("temperature", 1e-8, 1.0), 1.0) << "zero in a uniform shear";
  EXPECT_EQ(map_of(packing, "stress").title, "Pressure, coarse-grained over 10 D");
  pictures::MapSettings wide = settings_of("density");
  wide.length = 21.0;
  EXPECT_THROW(map_of(packing, wide), Error) << "wider than the bed";
}

// A row along x under 20 N: averaged over its surroundings, 20 N per square of grains and rows.
TEST(FieldMaps, PressureIsInRhoGD) {
  Packing packing = test::empty_packing(20.0, true);
  for (int row = 0; row < 20; ++row)
    for (int column = 0; column < 20; ++column) test::add_grain(packing, column + 0.5, row + 0.5);
  test::complete(packing);
  for (Index i = 0; i < 400; ++i)
    test::add_contact(packing, std::min(i, i % 20 < 19 ? i + 1 : i - 19),
                      std::max(i, i % 20 < 19 ? i + 1 : i - 19), 20.0, 0.0, i % 20 < 19 ? 0 : -1);
  pictures::MapSettings settings = in_gray("stress", 0.0, 2.0);
  settings.length = 8.0;
  EXPECT_NEAR(luma(fill_of(map_of(packing, settings), packing, 210)), 127.5, 3.0) << "20 Pa of 2 * 10 * 1";
}

}  // namespace
}  // namespace talus::render
