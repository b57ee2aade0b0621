#include <gtest/gtest.h>

#include <cmath>

#include "core/errors.h"
#include "render/furniture.h"
#include "render/layout.h"
#include "render/synthetic_view.h"

namespace talus {
namespace {

using test::synthetic_view;

std::vector<Box> all_boxes(const Layout& layout) {
  std::vector<Box> boxes = {layout.bed, layout.scale_bar, layout.arrow};
  if (layout.bar.width > 0.0) boxes.push_back(layout.bar);
  for (const PlacedText& text : layout.texts) boxes.push_back(text.box);
  for (const PlacedSwatch& swatch : layout.swatches) boxes.push_back(swatch.box);
  return boxes;
}

bool overlap(const Box& a, const Box& b) {
  return a.x < b.right() && b.x < a.right() && a.y < b.bottom() && b.y < a.bottom();
}

void expect_tidy(const Layout& layout, const std::string& what) {
  const std::vector<Box> boxes = all_boxes(layout);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    EXPECT_GT(boxes[i].width * boxes[i].height, 0.0) << what << ", box " << i;
    EXPECT_GE(boxes[i].x, 0.0) << what << ", box " << i;
    EXPECT_GE(boxes[i].y, 0.0) << what << ", box " << i;
    EXPECT_LE(boxes[i].right(), layout.width) << what << ", box " << i;
    EXPECT_LE(boxes[i].bottom(), layout.height) << what << ", box " << i;
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_FALSE(overlap(boxes[i], boxes[j])) << what << ", boxes " << j << " and " << i;
  }
}

TEST(Layout, NothingOverlapsAtAnyWidthInAnyBed) {
  const Font font = embedded_font();
  for (MapKind kind : {MapKind::gamma, MapKind::overloaded})
    for (auto [columns, rows] : {std::pair{200, 46}, {50, 10}, {20, 40}, {4, 3}}) {
      const FrameView view = synthetic_view(kind, columns, rows);
      for (int width : {200, 320, 400, 801, 1600, 4000})
        expect_tidy(lay_out(view, width, font), std::string(map_name(kind)) + " of " +
                                                    std::to_string(columns) + " columns at " +
                                                    std::to_string(width) + " px");
    }
}

TEST(Layout, WithoutFurnitureTheBedFillsThePicture) {
  FrameView view = synthetic_view(MapKind::gamma, 200, 46);
  view.furniture = false;
  const Layout layout = lay_out(view, 1600, embedded_font());
  EXPECT_EQ(layout.bed.x, 0.0);
  EXPECT_EQ(layout.bed.y, 0.0);
  EXPECT_EQ(layout.bed.width, 1600.0);
  EXPECT_EQ(layout.width, 1600);
  EXPECT_EQ(layout.bed.height, layout.height);
  EXPECT_NEAR(layout.height, 1600.0 * (view.y_max - view.y_min) / (view.x_max - view.x_min), 1.0);
  EXPECT_NEAR(layout.camera.origin_x + layout.camera.scale * view.x_min, 0.0, 1e-9);
  EXPECT_NEAR(layout.camera.origin_y - layout.camera.scale * view.y_min, layout.height, 1e-9);
  EXPECT_TRUE(layout.texts.empty());
  view.y_max = 100.0 * view.x_max;
  EXPECT_THROW(lay_out(view, 1600, embedded_font()), Error);
}

TEST(Layout, HoldsTheWholeBedInItsAspect) {
  const Font font = embedded_font();
  const FrameView view = synthetic_view(MapKind::gamma, 200, 46);
  const Layout layout = lay_out(view, 1600, font);
  const Camera& camera = layout.camera;
  EXPECT_NEAR(camera.origin_x + camera.scale * view.x_min, layout.bed.x, 1e-9);
  EXPECT_NEAR(camera.origin_x + camera.scale * view.x_max, layout.bed.right(), 1e-9);
  EXPECT_NEAR(camera.origin_y - camera.scale * view.y_min, layout.bed.bottom(), 1e-9);
  const double top = camera.origin_y - camera.scale * view.y_max;
  EXPECT_GE(top, layout.bed.y - 1e-9);
  EXPECT_LT(top, layout.bed.y + 1.0);
  EXPECT_NEAR(layout.scale_bar.width, camera.scale * 10 * 0.01, 0.5);  // 10 D
}

TEST(Layout, TextShrinksBeforeItIsRefused) {
  const Font font = embedded_font();
  FrameView view = synthetic_view(MapKind::gamma);
  view.title = std::string(80, 'm');
  EXPECT_LT(lay_out(view, 600, font).em, 10.0);
  view.title = std::string(400, 'm');
  EXPECT_THROW(lay_out(view, 600, font), Error);
}

TEST(Layout, RefusesPicturesThatAreTooSmallOrTooLarge) {
  const Font font = embedded_font();
  FrameView view = synthetic_view(MapKind::gamma);
  EXPECT_THROW(lay_out(view, smallest_width - 1, font), Error);
  EXPECT_THROW(lay_out(view, largest_side + 1, font), Error);
  view.y_max = 100.0 * view.x_max;
  EXPECT_THROW(lay_out(view, 1600, font), Error);
}

TEST(Layout, GravityArrowPointsAlongGravity) {
  const Font font = embedded_font();
  FrameView view = synthetic_view(MapKind::gamma);
  view.tilt = 0.3;
  const Layout layout = lay_out(view, 1600, font);
  const Segment shaft = furnish(view, layout, font, bake_glyphs(layout.em)).segments.at(0);
  EXPECT_NEAR(std::atan2(shaft.x1 - shaft.x0, shaft.y1 - shaft.y0), view.tilt, 1e-5);  // y counts downwards
}

}  // namespace
}  // namespace talus
