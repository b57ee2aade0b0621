#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/errors.h"
#include "core/trigonometry.h"
#include "maps/maps.h"
#include "render/synthetic_view.h"
#include "stress/overload.h"

namespace talus {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double theta_c = 0.35;
const double gamma_c = sine(theta_c);

/// One free grain of radius 1 at (x, 5) in a periodic bed of length 10, and no floor.
test::SyntheticBed one_grain(double x, double gamma) {
  test::SyntheticBed bed;
  bed.statics.periodic = true;
  bed.statics.length = 10.0;
  bed.statics.mean_diameter = 2.0;
  bed.statics.free_count = 1;
  bed.statics.radius = {1.0};
  bed.frame.x = {x};
  bed.frame.y = {5.0};
  bed.frame.gamma = {gamma};
  return bed;
}

std::vector<Disc> discs_of(const test::SyntheticBed& bed, MapKind kind) {
  return make_map(bed.frame, bed.statics, kind, theta_c, {0.0, 10.0}).discs;
}

TEST(GammaMap, IsWhiteBelowTheRangeBlackAboveAndLinearBetween) {
  EXPECT_EQ(gamma_shade(0.0, gamma_c), 0.0);
  EXPECT_EQ(gamma_shade(0.049, gamma_c), 0.0);
  EXPECT_EQ(gamma_shade(2.0 * gamma_c, gamma_c), 1.0);
  EXPECT_EQ(gamma_shade(1.0, gamma_c), 1.0);
  EXPECT_EQ(gamma_shade(nan, gamma_c), 0.0);
  for (double shade : {0.25, 0.5, 0.75})
    EXPECT_NEAR(gamma_shade(white_below + shade * (2.0 * gamma_c - white_below), gamma_c), shade, 1e-12);
}

TEST(GammaMap, BarSaysWhatTheShadesMean) {
  const FrameView view = test::synthetic_view(MapKind::gamma);
  ASSERT_EQ(view.bar_ticks.size(), 3u);
  EXPECT_EQ(view.bar_ticks[0].label, "0.05");
  EXPECT_EQ(view.bar_ticks[1].label, "Γ_c = 0.34");
  EXPECT_EQ(view.bar_ticks[2].label, "2Γ_c = 0.69");
  EXPECT_DOUBLE_EQ(view.bar_ticks[1].shade, gamma_shade(gamma_c, gamma_c));
  EXPECT_EQ(view.caption, "θ = 11.46°, θ_c = 20.05°");
}

TEST(OverloadedMap, IsBlackFromGammaCOn) {
  EXPECT_EQ(discs_of(one_grain(5.0, gamma_c), MapKind::overloaded)[0].shade, 1.0f);
  EXPECT_EQ(discs_of(one_grain(5.0, std::nextafter(gamma_c, 0.0)), MapKind::overloaded)[0].shade, 0.0f);
  EXPECT_EQ(discs_of(one_grain(5.0, nan), MapKind::overloaded)[0].shade, 0.0f);
}

TEST(OverloadedMap, CountsFreeGrainsThatCarrySomething) {
  test::SyntheticBed bed = test::make_synthetic_bed(5, 1);
  bed.frame.gamma = {gamma_c, 0.9, 0.1, nan, 0.2, 0.9, 0.9, 0.9, 0.9, 0.9};  // five free, five of the floor
  const OverloadCount count = count_overloaded(bed.frame, bed.statics, gamma_c);
  EXPECT_EQ(count.overloaded, 2);
  EXPECT_EQ(count.loaded, 4);
  const FrameView view = make_map(bed.frame, bed.statics, MapKind::overloaded, theta_c, {0.0, 0.1});
  EXPECT_EQ(view.title, "Overloaded grains, p_o = 0.500");
}

TEST(BareMap, TakesItsShadesAndHasNoFurniture) {
  const test::SyntheticBed bed = test::make_synthetic_bed(3, 1, false);
  const FrameView view = bare_map(bed.frame, bed.statics, std::vector<double>{0.0, 0.25, 1.0}, {-0.01, 0.05});
  ASSERT_EQ(view.discs.size(), 6u);
  EXPECT_EQ(view.discs[0].shade, 0.0f);
  EXPECT_EQ(view.discs[1].shade, 0.25f);
  EXPECT_EQ(view.discs[2].shade, 1.0f);
  EXPECT_EQ(view.discs[2].hatched, 0.0f);
  EXPECT_EQ(view.discs[3].hatched, 1.0f);
  EXPECT_FALSE(view.furniture);
  EXPECT_EQ(view.x_max, bed.statics.length);
  EXPECT_EQ(view.y_min, -0.01);
  EXPECT_EQ(view.y_max, 0.05);
  EXPECT_TRUE(make_map(bed.frame, bed.statics, MapKind::gamma, theta_c, {-0.01, 0.05}).furniture);
}

TEST(Map, CopiesDiscsAcrossAPeriodicEdge) {
  EXPECT_EQ(discs_of(one_grain(5.0, 0.1), MapKind::gamma).size(), 1u);
  const std::vector<Disc> left = discs_of(one_grain(0.5, 0.1), MapKind::gamma);
  ASSERT_EQ(left.size(), 2u);
  EXPECT_FLOAT_EQ(left[1].x, 10.5f);
  EXPECT_EQ(left[1].shade, left[0].shade);
  const std::vector<Disc> right = discs_of(one_grain(9.5, 0.1), MapKind::gamma);
  ASSERT_EQ(right.size(), 2u);
  EXPECT_FLOAT_EQ(right[1].x, -0.5f);

  test::SyntheticBed walls = one_grain(0.5, 0.1);
  walls.statics.periodic = false;
  EXPECT_EQ(discs_of(walls, MapKind::gamma).size(), 1u);
}

TEST(Map, HatchesTheFloorAndShowsItWhole) {
  const test::SyntheticBed bed = test::make_synthetic_bed(6, 2);
  MapExtent extent;
  extend(extent, bed.frame, bed.statics);
  EXPECT_DOUBLE_EQ(extent.y_min, -0.01);
  const FrameView view = make_map(bed.frame, bed.statics, MapKind::gamma, theta_c, extent);
  EXPECT_FALSE(view.floor_line);
  int hatched = 0;
  for (const Disc& disc : view.discs) hatched += disc.hatched > 0.5f;
  EXPECT_EQ(hatched, 6);
  EXPECT_TRUE(
      make_map(one_grain(5.0, 0.1).frame, one_grain(5.0, 0.1).statics, MapKind::gamma, theta_c, {0.0, 10.0})
          .floor_line);
}

TEST(Map, RefusesAnAngleOfReposeThatGivesNoScale) {
  const test::SyntheticBed bed = one_grain(5.0, 0.1);
  for (double angle : {nan, 0.0, -0.3, 1.6})
    EXPECT_THROW(make_map(bed.frame, bed.statics, MapKind::gamma, angle, {0.0, 10.0}), Error) << angle;
}

TEST(Map, KnowsItsNames) {
  for (MapKind kind : {MapKind::gamma, MapKind::overloaded}) EXPECT_EQ(map_kind(map_name(kind)), kind);
  EXPECT_THROW(map_kind("pressure"), Error);
}

}  // namespace
}  // namespace talus
