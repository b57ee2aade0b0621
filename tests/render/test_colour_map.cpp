#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "render/colour_map.h"

namespace talus::render {
namespace {

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
