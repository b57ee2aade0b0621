/// Data that the maps of a frame receive from neighbouring frames.

#include "pictures/picture_series.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/trigonometry.h"
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

/// Writes frames at 0, 1, 2 deg of the tilt, and a frame of the following flow, which is higher.
std::string example_run(const test::TemporaryFolder& folder) {
  io::Checkpoint checkpoint;
  checkpoint.world = row_of_grains();
  io::RunHeader header;
  header.statics.free_count = grains;
  header.statics.radius = checkpoint.world.grains.radius;
  header.statics.mass = checkpoint.world.grains.mass;
  header.statics.length = checkpoint.world.boundary.length;
  header.statics.depth = header.statics.mean_diameter = diameter;
  header.statics.gravity = 9.81;
  header.seed = 1;
  io::RunStore store = io::RunStore::create(folder.path("run.h5"), header, true);
  io::Segment segment;
  segment.frames = {frame_at(0.0, {{2, 12}}), frame_at(1.0, {{2, 12}, {15, 30}}),
                    frame_at(2.0, {{2, 12}, {15, 30}}), frame_at(1.5, {{2, 12}}, 0.25)};
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

TEST(PictureSeries, a_cluster_keeps_its_colour_whichever_frames_are_drawn) {
  const test::TemporaryFolder folder;
  DrawnRun run = open_drawn_run(example_run(folder), plan_of("clusters"), {});
  const render::Colour alone = fill_of(picture(run, 2, 0), 5);  // drawn first
  EXPECT_EQ(alone, fill_of(picture(run, 0, 0), 5));
  EXPECT_EQ(alone, fill_of(picture(run, 3, 0), 5)) << "in the flow too";
  const render::FrameView later = picture(run, 1, 0);
  EXPECT_EQ(alone, fill_of(later, 5));
  EXPECT_NE(alone, fill_of(later, 20)) << "the larger cluster that appeared later has another colour";
}

TEST(PictureSeries, all_frames_have_one_extent_and_the_largest_turn) {
  const test::TemporaryFolder folder;
  MapOptions options;
  options.turned = true;
  DrawnRun run = open_drawn_run(example_run(folder), plan_of("pressure", options), {});
  EXPECT_EQ(run.series.extent.y_min, 0.0);
  EXPECT_FLOAT_EQ(static_cast<float>(run.series.extent.y_max), 1.25f) << "in the flow, the highest frame";
  EXPECT_EQ(picture(run, 0, 0).y_max, run.series.extent.y_max);
  EXPECT_EQ(picture(run, 0, 0).turn_max, radians(2.0));
}

TEST(PictureSeries, what_moves_is_measured_from_the_frame_before_or_from_that_asked_for) {
  const test::TemporaryFolder folder;
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

TEST(PictureSeries, ranges_of_motion_fit_the_frames_that_are_drawn) {
  const test::TemporaryFolder folder;
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
  EXPECT_EQ(picture(fitted, 2, 0).legends[0].bars[0].title, "in D per degree, 5 to 99 % of grains");
}

TEST(PictureSeries, turned_beds_have_room_for_the_frames_that_are_drawn) {
  const test::TemporaryFolder folder;
  MapOptions options;
  options.turned = true;
  DrawnRun run = open_drawn_run(example_run(folder), plan_of("gamma", options), {});
  fit_to_frames(run, std::vector<std::size_t>{0, 1});
  EXPECT_DOUBLE_EQ(picture(run, 0, 0).turn_max, radians(1.0));
  EXPECT_DOUBLE_EQ(picture(run, 1, 0).turn_max, radians(1.0));
}

TEST(PictureSeries, traces_are_those_of_the_tilt) {
  const test::TemporaryFolder folder;
  MapOptions options;
  options.traces = "overloaded,stress_ratio";
  DrawnRun run = open_drawn_run(example_run(folder), plan_of("gamma", options), {});
  const render::FrameView view = picture(run, 1, 0);
  ASSERT_EQ(view.traces.size(), 2u);
  EXPECT_EQ(view.traces[0].y, (std::vector{10.0 / 40, 25.0 / 40, 25.0 / 40}));
  EXPECT_EQ(view.traces[1].y, (std::vector{0.1, 0.1, 0.1}));
  EXPECT_DOUBLE_EQ(view.traces[0].mark, 1.0);
}

}  // namespace
}  // namespace talus::pictures
