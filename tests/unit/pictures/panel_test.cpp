/// Common parts of the maps of a panel.

#include "pictures/panel.h"

#include <gtest/gtest.h>

#include <fmt/core.h>

#include "base/errors.h"

namespace talus::pictures {
namespace {

render::FrameView map_of(const std::string& title, int angle, const std::string& legend) {
  render::FrameView view;
  view.x_max = 1.0;
  view.title = title;
  view.caption = fmt::format("θ = {}.00°, θ_c = 20.00°", angle);
  view.scale_label = "10 D";
  view.legends = {{{}, {{render::Swatch::Kind::disc, render::white, render::black, 0.25, legend}}}};
  return view;
}

/// Returns two maps at two angles.
std::vector<std::vector<render::FrameView>> four_maps(const std::string& second_legend) {
  std::vector<std::vector<render::FrameView>> maps;
  for (const int angle : {5, 10})
    maps.push_back({map_of("Overloaded grains, l = 3 D, p_o = 0." + std::to_string(angle), angle, "black"),
                    map_of("Stress ratio", angle, second_legend)});
  return maps;
}

TEST(PanelRows, say_once_what_all_say) {
  const auto rows = panel_rows(four_maps("gray"), "");
  ASSERT_EQ(rows.size(), 3u) << "headings, and two angles";
  EXPECT_EQ(rows[0][0].title, "Overloaded grains, l = 3 D");
  EXPECT_EQ(rows[0][0].caption, "");
  EXPECT_EQ(rows[0][1].title, "Stress ratio");
  EXPECT_EQ(rows[0][1].caption, "θ_c = 20.00°");
  EXPECT_EQ(rows[1][0].title, "(a) p_o = 0.5");
  EXPECT_EQ(rows[1][0].caption, "θ = 5.00°");
  EXPECT_EQ(rows[1][1].title, "(b)");
  EXPECT_EQ(rows[1][1].caption, "") << "the caption is that of its row";
  EXPECT_EQ(rows[2][0].title, "(c) p_o = 0.10");
  EXPECT_TRUE(rows[1][0].legends.empty() && rows[1][1].legends.empty());
  EXPECT_EQ(rows[2][0].legends.size(), 1u);
  EXPECT_EQ(rows[2][1].legends.size(), 1u);
  EXPECT_EQ(rows[2][0].scale_label, "");
  EXPECT_EQ(rows[2][1].scale_label, "10 D");
}

TEST(PanelRows, have_one_legend_where_both_maps_have_the_same) {
  const auto rows = panel_rows(four_maps("black"), "");
  EXPECT_EQ(rows[2][0].legends.size(), 1u);
  EXPECT_TRUE(rows[2][1].legends.empty());
}

TEST(PanelRows, have_a_title_above_all) {
  const auto rows = panel_rows(four_maps("gray"), "A bed, seed 1");
  ASSERT_EQ(rows.size(), 4u);
  ASSERT_EQ(rows[0].size(), 1u);
  EXPECT_EQ(rows[0][0].title, "A bed, seed 1");
  EXPECT_EQ(rows[0][0].caption, "θ_c = 20.00°");
  EXPECT_EQ(rows[1][1].caption, "");
}

TEST(PanelRows, of_one_map_are_as_that_map) {
  const auto rows = panel_rows({{map_of("Stress ratio", 5, "black")}}, "");
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0][0].title, "Stress ratio");
  EXPECT_EQ(rows[0][0].caption, "θ = 5.00°, θ_c = 20.00°");
}

TEST(PanelRows, are_lettered_beyond_z) {
  std::vector<std::vector<render::FrameView>> maps;
  for (int row = 0; row < 28; ++row) maps.push_back({map_of("Stress ratio", row, "black")});
  const auto rows = panel_rows(std::move(maps), "");
  EXPECT_EQ(rows[26][0].title, "(z)");
  EXPECT_EQ(rows[27][0].title, "(aa)");
}

TEST(PanelSheet, stands_in_more_columns_where_it_would_be_too_high) {
  std::vector<std::vector<render::FrameView>> maps;
  for (const int angle : {0, 5, 10, 15, 20}) {
    maps.push_back({map_of("Stress ratio", angle, "black")});
    maps.back()[0].y_max = 0.4;
    maps.back()[0].tilt = angle;
  }
  const render::Font font = render::embedded_font();
  const render::Sheet tower = panel_sheet(maps, "", 1000, render::largest_side, font);
  const render::Sheet grid = panel_sheet(maps, "", 1000, 1300, font);
  EXPECT_EQ(tower.views.size(), 6u) << "a heading and five maps";
  EXPECT_GT(tower.height, 1300);
  EXPECT_LE(grid.height, 1300);
  ASSERT_EQ(grid.views.size(), 7u) << "the last row is filled up";
  EXPECT_EQ(grid.views[1].layout.bed.box.y, grid.views[2].layout.bed.box.y);
  EXPECT_EQ(grid.views[5].view.title, "(e)");
  EXPECT_EQ(grid.views[5].view.scale_label, "10 D") << "the scale bar of the last map";
  EXPECT_EQ(grid.views[6].view.title, "");
  EXPECT_EQ(grid.views[0].view.title, "Stress ratio") << "once";
}

TEST(PanelSheet, that_is_too_high_in_any_number_of_columns_is_refused) {
  std::vector<std::vector<render::FrameView>> maps(2, {map_of("Stress ratio", 0, "black")});
  maps[0][0].y_max = maps[1][0].y_max = 9.0;
  EXPECT_THROW(panel_sheet(maps, "", 4000, render::largest_side, render::embedded_font()), Error);
  maps[0][0].y_max = maps[1][0].y_max = 3.0;
  EXPECT_LE(panel_sheet(maps, "", 3000, render::largest_side, render::embedded_font()).height,
            render::largest_side)
      << "9000 px each, side by side";
}

TEST(PanelRows, keep_a_legend_that_differs) {
  auto maps = four_maps("gray");
  maps[0][0].legends[0].swatches[0].label = "white";
  const auto rows = panel_rows(maps, "");
  EXPECT_EQ(rows[1][0].legends.size(), 1u) << "it does not belong to the last angle";
  EXPECT_TRUE(rows[1][1].legends.empty());
}

TEST(PanelRows, beside_each_other_have_the_headings_of_all_angles) {
  auto maps = four_maps("gray");
  maps.push_back(
      {map_of("Overloaded grains, l = 3 D, p_o = 0.7", 15, "black"), map_of("Stress ratio", 15, "gray")});
  const auto rows = panel_rows(maps, "", 2);
  ASSERT_EQ(rows.size(), 3u);
  ASSERT_EQ(rows[0].size(), 4u);
  EXPECT_EQ(rows[0][2].title, "Overloaded grains, l = 3 D");
  EXPECT_EQ(rows[0][3].title, "Stress ratio");
  EXPECT_EQ(rows[1][2].title, "(c) p_o = 0.10");
  EXPECT_EQ(rows[2][0].title, "(e) p_o = 0.7");
  EXPECT_EQ(rows[2][2].title, "");
}

TEST(PanelRows, of_beds_alone_have_no_texts) {
  auto maps = four_maps("gray");
  for (auto& row : maps)
    for (render::FrameView& view : row) view.furniture = false;
  EXPECT_EQ(panel_rows(maps, "").size(), 2u) << "no headings";
}

}  // namespace
}  // namespace talus::pictures
