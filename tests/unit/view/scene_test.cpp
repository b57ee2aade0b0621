/// Marks drawn over the map of the hand-made bed, with four overloaded grains in column 0.

#include "view/scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/trigonometry.h"
#include "pictures/cluster_colours.h"
#include "unit/view/example_bed.h"

namespace talus::view {
namespace {

struct DrawnScene {
  pictures::PictureSeries pictures;
  Frame frame = example::bed_frame(10.0, 4);
  analysis::Clusters clusters;
  render::FrameView map;

  DrawnScene() {
    pictures.run.statics = example::bed_statics();
    settings().layers = {pictures::MapKind::gamma};
    settings().theta_c = radians(20.0);
    pictures.extent = pictures::bed_extent(pictures.run.statics);
    pictures::extend(pictures.extent, bed());
    clusters = pictures::overloaded_clusters(bed(), settings());
    map = draw_map(pictures, 0, frame, nullptr);
  }
  pictures::MapSettings& settings() {
    pictures.plan.maps.resize(1);
    return pictures.plan.maps[0];
  }
  BedFrame bed() const { return {frame, pictures.run.statics}; }
  render::FrameView shown(const Overlay& overlay, const pictures::MapExtent& part) const {
    render::FrameView view = shown_map(map, part, bed());
    add_overlay(view, bed(), overlay, clusters, pictures.extent);
    return view;
  }
  render::FrameView shown(const Overlay& overlay) const { return shown(overlay, pictures.extent); }
};

Overlay selection_of(Index grain) {
  Overlay overlay;
  overlay.selected = grain;
  return overlay;
}

TEST(GrowingDiameters, are_round_steps_up_to_the_one_chosen) {
  EXPECT_EQ(growing_diameters(10.0), (std::vector{2.0, 4.0, 6.0, 8.0, 10.0}));
  EXPECT_EQ(growing_diameters(7.0), (std::vector{2.0, 4.0, 6.0, 7.0}));
  EXPECT_EQ(growing_diameters(6.2), (std::vector{2.0, 4.0, 6.2})) << "none that touches the last";
  EXPECT_TRUE(growing_diameters(0.0).empty());
}

TEST(Scene, is_the_map_where_nothing_is_selected) {
  const DrawnScene drawn;
  const render::FrameView view = drawn.shown({});
  EXPECT_EQ(view.discs.size(), drawn.map.discs.size());
  EXPECT_TRUE(view.lines.empty());
  EXPECT_FALSE(view.furniture);
  EXPECT_TRUE(view.coloured) << "pictures with a selection are coloured, and all use one target";
}

TEST(Scene, has_the_grains_of_its_part) {
  const DrawnScene drawn;
  const render::FrameView view = drawn.shown({}, {3.1, 4.9, 1.1, 2.9});
  EXPECT_EQ(view.discs.size(), 4u);
  EXPECT_EQ(view.x_min, 3.1);
  EXPECT_EQ(view.y_max, 2.9);
}

TEST(Scene, rings_the_grain) {
  const DrawnScene drawn;
  const render::FrameView view = drawn.shown(selection_of(15));
  ASSERT_EQ(view.lines.size(), 128u);
  for (const render::Line& line : view.lines) {
    const double distance = std::hypot(line.x0 - 5.5, line.y0 - 1.5);
    EXPECT_GT(distance, 0.5);
    EXPECT_LT(distance, 0.75);
  }
}

TEST(Scene, draws_circles_through_the_periodic_edge) {
  const DrawnScene drawn;
  Overlay overlay = selection_of(10);  // grain at (0.5, 1.5)
  overlay.diameters = {3.0};
  const render::FrameView view = drawn.shown(overlay);
  const auto on_the_right = [](const render::Line& line) { return line.x0 > 8.9f && line.x1 > 8.9f; };
  EXPECT_GT(std::ranges::count_if(view.lines, on_the_right), 20);
  for (const render::Line& line : view.lines) {
    const double dx = line.x0 > 5.0f ? line.x0 - 10.5 : line.x0 - 0.5;
    const double distance = std::hypot(dx, line.y0 - 1.5);
    EXPECT_TRUE(std::abs(distance - 1.5) < 1e-5 || distance < 0.75);
  }
}

TEST(Scene, draws_no_circles_in_the_margins_of_a_bed) {
  const DrawnScene drawn;
  Overlay overlay = selection_of(10);
  overlay.diameters = {8.0};
  const pictures::MapExtent& bed = drawn.pictures.extent;
  const render::FrameView view =
      drawn.shown(overlay, {bed.x_min - 6.0, bed.x_max + 6.0, bed.y_min - 6.0, bed.y_max + 6.0});
  ASSERT_FALSE(view.lines.empty());
  constexpr double piece = 0.4;  // length of a straight line of that circle
  for (const render::Line& line : view.lines) {
    EXPECT_GT(std::min(line.x0, line.x1), bed.x_min - piece);
    EXPECT_LT(std::max(line.x0, line.x1), bed.x_max + piece);
    EXPECT_GT(std::min(line.y0, line.y1), bed.y_min - piece);
    EXPECT_LT(std::max(line.y0, line.y1), bed.y_max + piece);
  }
}

TEST(Scene, tells_l_c_from_other_circles) {
  const DrawnScene drawn;
  Overlay overlay = selection_of(15);
  overlay.diameters = {4.0};
  overlay.critical_length = 2.0;
  const render::FrameView view = drawn.shown(overlay);
  const auto colour_at_distance = [&view](double wanted) {
    render::Colour colour = render::white;
    for (const render::Line& line : view.lines)
      if (std::abs(std::hypot(line.x0 - 5.5, line.y0 - 1.5) - wanted) < 1e-5) colour = line.colour;
    return colour;
  };
  EXPECT_FALSE(colour_at_distance(1.0) == render::white);
  EXPECT_FALSE(colour_at_distance(2.0) == render::white);
  EXPECT_FALSE(colour_at_distance(1.0) == colour_at_distance(2.0));
}

/// Column 0 of four grains touches both neighbouring columns, one of them across the edge.
TEST(Scene, outlines_the_cluster_and_leaves_its_grains) {
  DrawnScene drawn;
  for (Index i = 0; i < example::columns * example::rows; ++i)
    if (i % example::columns != 0)
      drawn.frame.x[i] += 0.05;  // a gap on the right; the left contact stays closed
  Overlay overlay;
  overlay.cluster = 0;
  const render::FrameView view = drawn.shown(overlay);
  EXPECT_EQ(view.discs.size(), drawn.map.discs.size());
  for (std::size_t k = 0; k < view.discs.size(); ++k)
    EXPECT_TRUE(view.discs[k].fill == drawn.map.discs[k].fill);
  int right = 0, edge = 0;
  for (const render::Line& line : view.lines) {
    EXPECT_FALSE(render::is_gray(line.colour));
    EXPECT_NEAR(line.x0, line.x1, 1e-6) << "across the line of centres";
    EXPECT_NEAR(std::abs(line.y0 - line.y1), 0.6, 1e-6);
    const bool at_right = std::abs(line.x0 - 1.025f) < 1e-5f;
    right += at_right ? 1 : 0;
    edge += at_right ? 0 : 1;
  }
  EXPECT_EQ(right, 4);
  EXPECT_GE(edge, 4) << "one or two images each";
}

TEST(Scene, draws_walls_where_they_are) {
  DrawnScene drawn;
  drawn.pictures.run.statics.periodic = false;
  const render::FrameView view = drawn.shown({}, {-2.0, 12.0, -3.0, 6.0});
  ASSERT_EQ(view.lines.size(), 2u);
  EXPECT_EQ(view.lines[0].x0, 0.0f);
  EXPECT_EQ(view.lines[0].y0, 0.0f);
  EXPECT_EQ(view.lines[0].y1, 6.0f);
  EXPECT_EQ(view.lines[1].x1, 10.0f);
  EXPECT_EQ(drawn.shown({}, {2.0, 4.0, 0.0, 2.0}).lines.size(), 0u);
  EXPECT_FALSE(view.left_wall) << "it would lie at the edge of the picture";
}

TEST(Scene, knows_when_a_map_is_another) {
  const DrawnScene drawn;
  const auto frame = std::make_shared<const Frame>(drawn.frame);
  const MapKey own = map_key(drawn.pictures, 0, frame, nullptr);
  const auto changed = [&](const std::function<void(DrawnScene&)>& change, std::size_t k = 0) {
    DrawnScene other;
    change(other);
    return !(map_key(other.pictures, k, frame, nullptr) == own);
  };
  EXPECT_FALSE(changed([](DrawnScene&) {}));
  EXPECT_TRUE(changed([](DrawnScene& other) { other.settings().threshold_factor = 2.0; }));
  EXPECT_TRUE(changed([](DrawnScene& other) { other.pictures.extent.y_max += 1.0; }));
  EXPECT_TRUE(changed([](DrawnScene& other) { other.pictures.since = 1; }));
  EXPECT_NE(own, map_key(drawn.pictures, 0, frame, frame));
  EXPECT_NE(own, map_key(drawn.pictures, 0, std::make_shared<const Frame>(drawn.frame), nullptr));
  EXPECT_FALSE(changed([](DrawnScene& other) { pictures::add_frame(other.pictures, other.frame); }))
      << "it shows no clusters";
}

TEST(Scene, colours_of_clusters_depend_on_the_frames_met) {
  DrawnScene drawn;
  drawn.settings().layers = {pictures::MapKind::clusters};
  const auto frame = std::make_shared<const Frame>(drawn.frame);
  const auto source = [&] { return map_key(drawn.pictures, 1, frame, nullptr); };
  const MapKey none = source();
  pictures::add_frame(drawn.pictures, drawn.frame);
  const MapKey one = source();
  EXPECT_NE(none, one) << "colours follow those of the first frame";
  pictures::add_frame(drawn.pictures, drawn.frame);
  const MapKey two = source();
  EXPECT_NE(one, two) << "the frame itself was added";
  pictures::add_frame(drawn.pictures, drawn.frame);
  EXPECT_EQ(two, source()) << "later frames change nothing";
  drawn.pictures.seen_frames.rule.threshold_factor = 2.0;
  EXPECT_NE(two, source()) << "colours by another rule belong to other clusters";
}

TEST(Scene, gives_the_reason_where_a_map_cannot_be_drawn) {
  DrawnScene drawn;
  drawn.settings().theta_c = radians(1.0);
  const render::FrameView view = draw_map(drawn.pictures, 0, drawn.frame, nullptr);
  EXPECT_NE(view.title.find("angle of repose"), std::string::npos);
  EXPECT_EQ(view.discs.size(), drawn.map.discs.size());
}

}  // namespace
}  // namespace talus::view
