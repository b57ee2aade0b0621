/// Maps of the difference between two frames.

#include <gtest/gtest.h>

#include <cmath>

#include "pictures/change_map.h"
#include "render/map_bed.h"

namespace talus::render {
namespace {

using test::extent_of, test::Packing, test::row_of_grains, test::settings_of;

/// Three adjacent grains in a periodic bed of 3 D: the frame at 7 deg, and its reference at 5 deg.
struct ChangedBed {
  Packing now, before;

  ChangedBed(const std::vector<double>& gamma_now, const std::vector<double>& gamma_before)
      : now(row_of_grains(gamma_now, true)), before(row_of_grains(gamma_before, true)) {
    now.frame.tilt = radians(7.0);
    before.frame.tilt = radians(5.0);
  }
  pictures::MapFrame frame() const { return {{now.frame, now.statics}, &before.frame, false}; }
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
  EXPECT_EQ(layers[0].legend.bars.at(0).title, "in powers of ten");
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

TEST(ChangeMap, ALostContactPointsToTheImageThatItWasWith) {
  ChangedBed changed({0.1, 0.1, 0.1}, {0.1, 0.1, 0.1});
  test::add_contact(changed.before, 0, 2, 1.0, 0.0, -1);  // grain 2 to the left of grain 0
  changed.now.frame.x[0] = 2.9;                           // has left on the left and is now on the right
  changed.now.frame.image[0] = -1;
  changed.now.frame.x[2] = 2.0;
  const auto layers = pictures::change_layers(changed.frame(), settings_of("gamma"), extent_of(changed.now));
  ASSERT_EQ(layers[1].lines.size(), 2u);
  EXPECT_FLOAT_EQ(layers[1].lines[0].x0, 2.9f);
  EXPECT_FLOAT_EQ(layers[1].lines[0].x1, 2.4f);
}

TEST(ChangeMap, ALostContactPointsThroughTheEdgeThatItsGrainHasLeftThrough) {
  ChangedBed changed({0.1, 0.1, 0.1}, {0.1, 0.1, 0.1});
  test::add_contact(changed.before, 0, 2, 1.0);  // grain 2 to the right of grain 0, in the same image
  changed.now.frame.x[0] = 2.9;                  // has left on the left
  changed.now.frame.image[0] = -1;
  changed.now.frame.x[2] = 2.0;
  const auto layers = pictures::change_layers(changed.frame(), settings_of("gamma"), extent_of(changed.now));
  ASSERT_EQ(layers[1].lines.size(), 2u);
  EXPECT_FLOAT_EQ(layers[1].lines[0].x0, 2.9f);
  EXPECT_FLOAT_EQ(layers[1].lines[0].x1, 3.4f);
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
