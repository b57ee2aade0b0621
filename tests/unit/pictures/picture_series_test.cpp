/// Series of pictures: colours, ranges, traces, and frames of movies. Common parts of the maps of a panel.

#include "pictures/picture_series.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fmt/core.h>

#include "base/errors.h"
#include "base/hash.h"
#include "core/trigonometry.h"
#include "io/packed_file.h"
#include "pictures/panel.h"
#include "pictures/picture_files.h"
#include "pictures/run_movie.h"
#include "support/exit_code.h"
#include "support/temporary_folder.h"

namespace talus::pictures {
namespace {

constexpr Index grains = 40;
constexpr double diameter = 1.0;

/// Returns a row of touching grains in a bed between walls.
World row_of_grains() {
  World world;
  world.boundary.length = grains * diameter;
  for (Index i = 0; i < grains; ++i)
    add_disk(world.grains, {(i + 0.5) * diameter, 0.5 * diameter}, 0.5 * diameter, 1.0, false);
  world.grains.free_count = grains;
  return world;
}

/// Returns the row at a tilt in degrees, shifted by a tenth of it, with the grains in these ranges
/// overloaded.
Frame frame_at(double tilt, const std::vector<std::pair<Index, Index>>& overloaded, double height = 0.0) {
  Frame frame;
  frame.step = std::lround(100.0 * tilt);
  frame.time = tilt;
  frame.tilt = radians(tilt);
  const std::vector<double> none(grains, 0.0);
  for (auto* field : {&frame.y, &frame.angle, &frame.vx, &frame.vy, &frame.omega}) *field = none;
  frame.image.assign(grains, 0);
  frame.internal_moment.assign(grains, {1.0, 0.0, 0.0, 1.0});
  frame.gamma.assign(grains, 0.01);
  for (const auto& [first, last] : overloaded)
    std::fill(frame.gamma.begin() + first, frame.gamma.begin() + last, 0.9);
  for (Index i = 0; i < grains; ++i) {
    frame.x.push_back((i + 0.5) * diameter + 0.1 * tilt);
    frame.y[static_cast<std::size_t>(i)] = 0.5 * diameter + height;
  }
  return frame;
}

/// Writes frames at 0, 1, 2 deg of the tilt, and a frame of the following flow, which is higher. All are at
/// least at this height.
std::string example_run(const test::TemporaryFolder& folder, double height = 0.0, Index free_count = grains) {
  io::Checkpoint checkpoint;
  checkpoint.world = row_of_grains();
  checkpoint.world.grains.free_count = free_count;
  io::RunHeader header;
  header.statics.free_count = free_count;
  header.statics.radius = checkpoint.world.grains.radius;
  header.statics.mass = checkpoint.world.grains.mass;
  header.statics.length = checkpoint.world.boundary.length;
  header.statics.depth = header.statics.mean_diameter = diameter;
  header.statics.gravity = 9.81;
  header.seed = 1;
  io::RunStore store = io::RunStore::create(folder.path("run.h5"), header, true);
  io::Segment segment;
  segment.frames = {frame_at(0.0, {{2, 12}}, height), frame_at(1.0, {{2, 12}, {15, 30}}, height),
                    frame_at(2.0, {{2, 12}, {15, 30}}, height), frame_at(1.5, {{2, 12}}, height + 0.25)};
  for (Frame& frame : segment.frames) {
    frame.step = checkpoint.world.step++;
    ObservableRow& row = segment.observables.emplace_back();
    at(row, Observable::step) = static_cast<double>(frame.step);
    at(row, Observable::tilt) = frame.tilt;
    at(row, Observable::stress_ratio) = 0.1;
  }
  checkpoint.integers = {{"flow_steps", 2}};  // the last of which follow the last frame
  store.commit(segment, checkpoint);
  return folder.path("run.h5");
}

MapPlan plan_of(const std::string& map, MapOptions options = {}) {
  options.maps = {map};
  options.theta_c = 20.0;
  if (map.starts_with("clusters") || map.starts_with("gamma")) options.l_min = options.l_min.value_or(0.0);
  options.joined = map.starts_with("clusters") ? std::optional<std::string>("neighbours") : std::nullopt;
  return plan_maps(options);
}

render::Colour fill_of(const render::FrameView& view, Index grain) {
  return view.discs[static_cast<std::size_t>(grain)].fill;
}

using PictureSeriesTest = test::FolderTest;

TEST_F(PictureSeriesTest, a_cluster_keeps_its_colour_whichever_frames_are_drawn) {
  DrawnRun run = open_drawn_run(example_run(folder, 2.0), plan_of("clusters"), {});  // far above the floor
  const render::Colour alone = fill_of(picture(run, 2, 0), 5);                       // drawn first
  EXPECT_EQ(alone, fill_of(picture(run, 0, 0), 5));
  EXPECT_EQ(alone, fill_of(picture(run, 3, 0), 5)) << "in the flow too";
  const render::FrameView later = picture(run, 1, 0);
  EXPECT_EQ(alone, fill_of(later, 5));
  EXPECT_NE(alone, fill_of(later, 20)) << "the larger cluster that appeared later has another colour";
}

TEST_F(PictureSeriesTest, the_cluster_that_spans_the_bed_has_one_colour_in_all_frames) {
  DrawnRun run = open_drawn_run(example_run(folder), plan_of("clusters"), {});  // all reach floor and surface
  EXPECT_EQ(fill_of(picture(run, 0, 0), 5), cluster_palette().front());
  for (const Index grain : {5, 20})
    EXPECT_EQ(fill_of(picture(run, 1, 0), grain), cluster_palette().front()) << "both of two";
}

TEST_F(PictureSeriesTest, of_a_slope_that_stands_have_the_assumed_angle_where_they_need_one) {
  const std::string path = example_run(folder);
  const auto caption = [&](const MapOptions& options) {
    DrawnRun run = open_drawn_run(path, plan_maps(options), {});
    return picture(run, 1, 0).caption;
  };
  for (const char* map : {"gamma", "overloaded", "clusters", "coarse+forces"}) {
    MapOptions options;
    options.maps = {map};
    options.length = map == std::string("coarse+forces") ? std::optional(5.0) : std::nullopt;
    EXPECT_EQ(caption(options), "θ = 1.00°, θ_c = 20.00° (assumed)") << map;
    options.theta_c = 19.0;
    EXPECT_EQ(caption(options), "θ = 1.00°, θ_c = 19.00° (assumed)") << map;
  }
  MapOptions pressure;
  pressure.maps = {"pressure"};
  EXPECT_EQ(caption(pressure), "θ = 1.00°");
  pressure.traces = "overloaded";
  EXPECT_EQ(caption(pressure), "θ = 1.00°, θ_c = 20.00° (assumed)");
}

TEST_F(PictureSeriesTest, of_a_slope_that_has_failed_have_its_angle_unless_another_is_given) {
  MapOptions options;
  options.maps = {"gamma"};
  MapPlan plan = plan_maps(options);
  settle_theta_c(plan, radians(25.0));
  EXPECT_EQ(plan.maps[0].theta_c, radians(25.0));
  EXPECT_FALSE(plan.maps[0].theta_c_assumed);
  options.theta_c = 19.0;
  plan = plan_maps(options);
  settle_theta_c(plan, radians(25.0));
  EXPECT_EQ(plan.maps[0].theta_c, radians(19.0));
  EXPECT_TRUE(plan.maps[0].theta_c_assumed);
}

TEST_F(PictureSeriesTest, all_frames_have_one_extent_and_the_largest_turn) {
  MapOptions options;
  options.turned = true;
  DrawnRun run = open_drawn_run(example_run(folder), plan_of("pressure", options), {});
  EXPECT_EQ(run.series.extent.y_min, 0.0);
  EXPECT_FLOAT_EQ(static_cast<float>(run.series.extent.y_max), 1.25f) << "in the flow, the highest frame";
  EXPECT_EQ(picture(run, 0, 0).y_max, run.series.extent.y_max);
  EXPECT_EQ(picture(run, 0, 0).turn_max, radians(2.0));
}

TEST_F(PictureSeriesTest, what_moves_is_measured_from_the_frame_before_or_from_that_asked_for) {
  const std::string path = example_run(folder);
  DrawnRun before = open_drawn_run(path, plan_of("displacement"), {});
  EXPECT_EQ(picture(before, 2, 0).title, "Displacement per degree of tilt");
  const render::Colour still = fill_of(picture(before, 0, 0), 5);
  const render::Colour steady = fill_of(picture(before, 1, 0), 5);
  EXPECT_NE(steady, still) << "at 0 deg nothing has moved yet";
  EXPECT_EQ(fill_of(picture(before, 2, 0), 5), steady) << "each frame has moved as far as the one before";

  MapOptions options;
  options.since = 0.9;  // the nearest frame is at 1 deg
  DrawnRun since = open_drawn_run(path, plan_of("displacement", options), {});
  EXPECT_EQ(picture(since, 2, 0).title, "Displacement since 1.00°");
  EXPECT_NE(fill_of(picture(since, 2, 0), 5), still);
  EXPECT_EQ(fill_of(picture(since, 1, 0), 5), still) << "motion is measured from this frame";
  EXPECT_EQ(fill_of(picture(since, 0, 0), 5), still) << "before it nothing has moved";
}

TEST_F(PictureSeriesTest, values_of_scripts_are_maps_by_their_name_on_one_scale) {
  const std::string path = example_run(folder, 0.0, grains - 1);
  io::RunHeader header;
  io::Checkpoint checkpoint;
  io::RunStore::resume(path, header, checkpoint).pack();
  OwnQuantity own{{}, OwnQuantity::Kind::number, "v_s", "m/s", "slip", true};
  for (int k = 0; k < 4 * grains; ++k) own.values.push_back(k);
  io::store_own(path, own, hash_text(state_hash(checkpoint.world)));
  MapOptions options;
  options.maps = {"slip", "slip+forces"};
  DrawnRun run = open_drawn_run(path, plan_maps(options, path), {});
  for (const std::size_t k : {0U, 3U}) {
    const render::FrameView view = picture(run, k, 0);
    const render::Bar& bar = view.legends.at(0).bars.at(0);
    EXPECT_EQ(view.title, "v_s");
    EXPECT_EQ(bar.title, "v_s (m/s)");
    EXPECT_EQ(bar.low, 0.0);
    EXPECT_EQ(bar.high, 4 * grains - 2.0) << "without the floor";
    EXPECT_EQ(bar.values.at(2), k * grains + 2.0);
  }
  EXPECT_EQ(picture(run, 1, 1).title, "v_s; force chains, width by f_n");
  const std::vector<PictureFile> files = picture_files(run, {0}, "maps", "png");
  EXPECT_EQ(files.at(0).path, "maps/slip_000.00.png");
  EXPECT_EQ(files.at(1).path, "maps/slip+forces_000.00.png");
  options.maps = {"slop"};
  EXPECT_TRUE(test::refuses([&] { plan_maps(options, path); }, ExitCode::usage,
                            {"gamma, ", ", slip", "did you mean 'slip'?"}));
  options.maps = {"slip+pressure"};
  EXPECT_EQ(name_of(plan_maps(options, path).maps[0]), "slip+pressure");
  for (const char* name : {"forces+slip", "slip+slip", "slip+forces+critical"}) {
    options.maps = {name};
    EXPECT_TRUE(test::refuses([&] { plan_maps(options, path); }, ExitCode::usage, {name}));
  }
}

TEST_F(PictureSeriesTest, ranges_of_motion_fit_the_frames_that_are_drawn) {
  const std::string path = example_run(folder);
  const auto ends = [&path](const std::vector<std::size_t>& frames) {
    MapOptions options;
    options.since = 0.0;
    DrawnRun run = open_drawn_run(path, plan_of("displacement", options), {});
    fit_to_frames(run, frames);
    const ScaleRange range =
        run.series.plan.maps[0].motion.range(MapKind::displacement, false).value_or(ScaleRange{0.0, 0.0});
    return std::pair(std::lround(1000.0 * range.low), std::lround(1000.0 * range.high));
  };
  // Values in thousandths of D. All grains have moved by 0.1 D at 1 deg, and by 0.2 D at 2 deg.
  EXPECT_EQ(ends({1}), std::pair(51L, 100L)) << "half of the upper end if all grains move alike";
  EXPECT_EQ(ends({1, 2}), std::pair(100L, 200L));
  EXPECT_EQ(ends({0}), std::pair(0L, 0L)) << "nothing has moved: the fixed range stays";
  DrawnRun fitted = open_drawn_run(path, plan_of("displacement"), {});
  fit_to_frames(fitted, std::vector<std::size_t>{0, 1, 2});
  EXPECT_EQ(picture(fitted, 2, 0).legends[0].bars[0].title,
            "displacement (D per degree), 5 to 99 % of grains");
}

TEST_F(PictureSeriesTest, turned_beds_have_room_for_the_frames_that_are_drawn) {
  MapOptions options;
  options.turned = true;
  DrawnRun run = open_drawn_run(example_run(folder), plan_of("gamma", options), {});
  fit_to_frames(run, std::vector<std::size_t>{0, 1});
  EXPECT_DOUBLE_EQ(picture(run, 0, 0).turn_max, radians(1.0));
  EXPECT_DOUBLE_EQ(picture(run, 1, 0).turn_max, radians(1.0));
}

TEST_F(PictureSeriesTest, traces_are_those_of_the_tilt) {
  MapOptions options;
  options.traces = "overloaded,stress_ratio";
  DrawnRun run = open_drawn_run(example_run(folder), plan_of("gamma", options), {});
  const render::FrameView view = picture(run, 1, 0);
  ASSERT_EQ(view.traces.size(), 2u);
  EXPECT_EQ(view.traces[0].y, (std::vector{10.0 / 40, 25.0 / 40, 25.0 / 40}));
  EXPECT_EQ(view.traces[1].y, (std::vector{0.1, 0.1, 0.1}));
  EXPECT_DOUBLE_EQ(view.traces[0].mark, 1.0);
}

std::vector<double> rad(std::vector<double> angles) {
  for (double& angle : angles) angle = radians(angle);
  return angles;
}

/// Returns the frame of the run shown in each frame of the movie.
std::vector<std::size_t> shown(const std::vector<double>& clock, const MovieTiming& timing) {
  std::vector<std::size_t> frames;
  for (const MovieFrame& frame : movie_frames(clock, timing))
    frames.insert(frames.end(), static_cast<std::size_t>(frame.times), frame.frame);
  return frames;
}

TEST(MovieFrames, without_a_speed_each_is_shown_once) {
  MovieTiming timing;
  EXPECT_EQ(shown(rad({0, 1, 2, 2.1, 3}), timing), (std::vector<std::size_t>{0, 1, 2, 3, 4}));
  timing.every = 2.0;
  EXPECT_EQ(shown(rad({0, 1, 2, 3, 4}), timing), (std::vector<std::size_t>{0, 2, 4}));
}

TEST(MovieFrames, with_a_speed_each_shows_the_last_one_before_its_angle) {
  MovieTiming timing;
  timing.fps = 4.0;
  timing.speed = 2.0;  // half a degree per frame of the movie: 0, 0.5, 1, ...
  EXPECT_EQ(shown(rad({0, 1, 1.7, 2}), timing), (std::vector<std::size_t>{0, 0, 1, 1, 3, 3, 3, 3, 3}))
      << "the frame at 1.7 is never the last; the end is held for a second";
}

TEST(MovieFrames, stay_at_both_ends_where_that_is_asked_for) {
  MovieTiming timing;
  timing.fps = 2.0;
  timing.hold = 1.0;
  EXPECT_EQ(shown(rad({0, 1, 2}), timing), (std::vector<std::size_t>{0, 0, 0, 1, 2, 2, 2}));
  timing.speed = 2.0;
  EXPECT_EQ(shown(rad({0, 1, 2}), timing), (std::vector<std::size_t>{0, 0, 0, 1, 2, 2, 2}));
  EXPECT_EQ(shown(rad({0}), timing).size(), 3u) << "a single frame is the first and the last";
  timing.hold = 0.0;
  EXPECT_EQ(shown(rad({0, 1, 2}), timing), (std::vector<std::size_t>{0, 1, 2}));
}

TEST(MovieFrames, are_as_many_as_angle_and_speed_say) {
  MovieTiming timing;
  timing.fps = 30.0;
  timing.speed = 0.7;
  std::vector<double> clock;
  for (int k = 0; k <= 61; ++k) clock.push_back(0.25 * k);
  const auto frames = shown(rad(clock), timing);
  EXPECT_EQ(frames.size(), static_cast<std::size_t>(std::ceil(15.25 / 0.7 * 30.0)) + 1 + 30);
  for (std::size_t j = 0; j + 31 < frames.size(); ++j) {
    const double angle = static_cast<double>(j) * 0.7 / 30.0;
    EXPECT_LE(clock[frames[j]], angle + 1e-6);
    EXPECT_GT(clock[frames[j] + 1], angle - 1e-6);
  }
}

render::FrameView map_of(const std::string& title, int angle, const std::string& legend) {
  render::FrameView view;
  view.x_max = 1.0;
  view.title = title;
  view.caption = fmt::format("θ = {}.00°, θ_c = 20.00°", angle);
  view.scale_label = "10 D";
  view.legends = {{{}, {{render::Swatch::Kind::disc, render::white, render::black, 0.25, legend}}}};
  return view;
}

TEST(RowOfMaps, has_angle_and_arrow_at_the_first_map_and_the_scale_bar_at_the_last) {
  std::vector<render::FrameView> maps = {map_of("A", 5, "black"), map_of("B", 5, "black"),
                                         map_of("C", 6, "black")};
  share_row(maps);
  for (const render::FrameView& map : maps) EXPECT_TRUE(map.arrow_in_caption);
  EXPECT_FALSE(maps[0].caption.empty());
  EXPECT_TRUE(maps[1].caption.empty());
  EXPECT_FALSE(maps[2].caption.empty()) << "another angle";
  EXPECT_TRUE(maps[0].scale_label.empty() && maps[1].scale_label.empty() && !maps[2].scale_label.empty());
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
  EXPECT_TRUE(rows[1][0].arrow_in_caption && rows[2][0].arrow_in_caption) << "with or without a scale bar";
}

TEST(PanelRows, of_clusters_have_short_captions) {
  auto maps = four_maps("gray");
  maps[0][1].title = "Clusters of overloaded grains, l = 3 D, 30 clusters, largest 13 %";
  maps[1][1].title = "Clusters of overloaded grains, l = 3 D, 1 cluster, largest 100 %";
  const auto rows = panel_rows(maps, "");
  EXPECT_EQ(rows[0][0].title, "Overloaded grains, l = 3 D");
  EXPECT_EQ(rows[0][1].title, "Clusters of overloaded grains, l = 3 D");
  EXPECT_EQ(rows[1][0].title, "(a) p_o = 0.5");
  EXPECT_EQ(rows[1][1].title, "(b) 30 clusters, largest 13 %");
}

TEST(PanelRows, have_one_legend_where_both_maps_have_the_same_and_keep_one_that_differs) {
  const auto rows = panel_rows(four_maps("black"), "");
  EXPECT_EQ(rows[2][0].legends.size(), 1u);
  EXPECT_TRUE(rows[2][1].legends.empty());
  auto maps = four_maps("gray");
  maps[0][0].legends[0].swatches[0].label = "white";
  const auto others = panel_rows(maps, "");
  EXPECT_EQ(others[1][0].legends.size(), 1u) << "it does not belong to the last angle";
  EXPECT_TRUE(others[1][1].legends.empty());
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
