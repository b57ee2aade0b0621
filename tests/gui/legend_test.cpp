/// The legend of the map sets its range, and hovering shows values with units.

#include <gtest/gtest.h>

#include "gui/offscreen_fixture.h"
#include "gui/panels.h"
#include "pictures/picture_series.h"

namespace talus {
namespace {

using test::Replay;

TEST_F(Replay, the_ends_of_the_legend_set_the_range) {
  const render::Bar before = model_.first().annotated_map().legends[0].bars[0];
  gui_.drag("legend bar", 1.0f, 0.5f, 1.5f, 0.5f);
  ASSERT_TRUE(model_.state.map.range_high.has_value());
  EXPECT_NEAR(*model_.state.map.range_high, before.high + 0.5 * (before.high - before.low), 0.01);
  EXPECT_EQ(*model_.state.map.range_low, before.low) << "the other end stays";
  gui_.drag("legend bar", 0.0f, 0.5f, 0.25f, 0.5f);
  EXPECT_GT(*model_.state.map.range_low, before.low + 0.1);
  EXPECT_NE(model_.render_command().find("--range"), std::string::npos);
  gui_.double_click("legend bar");
  EXPECT_FALSE(model_.state.map.range_low || model_.state.map.range_high);
  EXPECT_EQ(model_.first().annotated_map().legends[0].bars[0].high, before.high);
}

TEST_F(Replay, a_click_on_the_legend_changes_nothing) {
  gui_.click("legend bar", 0.02f);
  gui_.click("legend bar", 0.5f);
  EXPECT_FALSE(model_.state.map.range_low || model_.state.map.range_high);
}

TEST_F(Replay, a_scale_bar_stands_beside_the_arrow_of_gravity) {
  const auto length = [this] {
    gui_.frame();
    const gui::WidgetPlace bar = gui_.place("scale"), gravity = gui_.place("gravity");
    EXPECT_LT(bar.x1, gravity.x0);
    return static_cast<double>(bar.x1 - bar.x0);
  };
  const auto pixels = [this] {  // size of D in pixels
    const gui::WidgetPlace map = gui_.place("map");
    const double aspect = static_cast<double>(map.x1 - map.x0) / static_cast<double>(map.y1 - map.y0);
    const pictures::MapExtent part = model_.first().part(aspect);
    return (map.x1 - map.x0) / (part.x_max - part.x_min) * model_.mean_diameter();
  };
  for (const double zoom : {1.0, 3.0}) {
    model_.state.camera.zoom = zoom;
    const double bar = length(), diameters = bar / pixels();
    EXPECT_NEAR(diameters, zoom == 1.0 ? 1.0 : 0.2, 0.01) << "a round number that fits next to the legend";
    EXPECT_GT(bar, 15.0);
  }
}

TEST_F(Replay, all_of_the_legend_is_seen_beside_the_arrow_of_gravity) {
  model_.state.map.layers = {pictures::MapKind::clusters, pictures::MapKind::forces};
  for (const int width : {1280, 1400, 1500, 1700}) {
    gui_.resize(width, 900);
    gui_.frame();
    const gui::WidgetPlace gravity = gui_.place("gravity"), below = gui_.place("border");
    int swatches = 0;
    for (const render::Legend& legend : model_.first().annotated_map().legends)
      for (const render::Swatch& swatch : legend.swatches) {
        const gui::WidgetPlace at = gui_.place("swatch " + swatch.label);
        EXPECT_LE(at.y1, below.y0) << swatch.label << " at " << width;
        EXPECT_TRUE(at.x1 <= gravity.x0 || at.y0 >= gravity.y1) << swatch.label << " at " << width;
        ++swatches;
      }
    EXPECT_GE(swatches, 4) << width;
  }
}

TEST_F(Replay, a_grain_is_told_in_the_unit_of_the_map) {
  model_.go_to(2);
  const auto shown_view = [&](pictures::MapKind kind) {
    model_.state.map.layers = {kind};
    gui_.frame();
    return gui::grain_text(model_.first(), 7);
  };
  EXPECT_NE(shown_view(pictures::MapKind::speed).find("speed = "), std::string::npos);
  EXPECT_TRUE(shown_view(pictures::MapKind::speed).ends_with(" √(gD)"))
      << shown_view(pictures::MapKind::speed);
  EXPECT_TRUE(shown_view(pictures::MapKind::pressure).ends_with(" ρgD"))
      << shown_view(pictures::MapKind::pressure);
  EXPECT_TRUE(shown_view(pictures::MapKind::rotation).ends_with("° per degree"))
      << shown_view(pictures::MapKind::rotation);
  EXPECT_TRUE(shown_view(pictures::MapKind::displacement).ends_with(" D per degree"))
      << shown_view(pictures::MapKind::displacement);
  EXPECT_NE(shown_view(pictures::MapKind::overloaded).find("γ = "), std::string::npos);
  EXPECT_EQ(shown_view(pictures::MapKind::forces), "grain 7");
  EXPECT_TRUE(gui::grain_text(model_.first(), model_.statics().free_count).starts_with("floor grain "));
  for (const pictures::MapKind kind : pictures::map_kinds()) {
    if (!pictures::has_bar({kind})) continue;
    EXPECT_NE(shown_view(kind).find(" = "), std::string::npos) << pictures::map_name(kind);
  }
}

TEST_F(Replay, the_range_of_a_map_of_motion_fits_the_frame_shown) {
  EXPECT_FALSE(gui_.has("fit")) << "gamma has its own range";
  model_.state.map.layers = {pictures::MapKind::displacement};
  model_.go_to(3);
  gui_.settle();
  const auto fitting = model_.first().fitting_range();
  ASSERT_TRUE(fitting);
  ASSERT_TRUE(test::drawn_until(gui_, [this] { return model_.all_values_known(); }));
  pictures::MapPlan plan;
  plan.maps.resize(1);
  plan.maps[0].layers = {pictures::MapKind::displacement};
  pictures::DrawnRun drawn = pictures::open_drawn_run(folder_.path("bed.h5"), plan, {});
  const std::size_t shown = 3;
  pictures::fit_to_frames(drawn, {&shown, 1});
  EXPECT_EQ(fitting, drawn.series.plan.maps[0].motion.range(pictures::MapKind::displacement, true))
      << "that of talus render";
  const render::Image fixed = gui_.frame();
  gui_.click("fit");
  EXPECT_EQ(model_.state.map.range_low, std::optional(fitting->low));
  EXPECT_EQ(model_.state.map.range_high, std::optional(fitting->high));
  EXPECT_NE(gui_.frame().pixels, fixed.pixels);
}

}  // namespace
}  // namespace talus
