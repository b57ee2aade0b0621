/// Several views in one picture: rows of a panel, and frames of a movie in a given size.

#include <gtest/gtest.h>

#include "base/errors.h"
#include "render/sample_view.h"
#include "render/sheet.h"

namespace talus::render {
namespace {

FrameView curves_alone() {
  FrameView view;
  view.letters = test::sample_view().letters;
  view.traces = {test::sample_trace("p_o"), test::sample_trace("Γ")};
  return view;
}

/// Returns the part of a sheet that a view occupies, px.
Box extent_of(const Layout& layout) {
  Box box = layout.bed.box.width > 0.0 ? layout.bed.box : layout.traces.at(0).box;
  const auto include = [&box](const Box& other) {
    const double right = std::max(box.right(), other.right()),
                 bottom = std::max(box.bottom(), other.bottom());
    box.x = std::min(box.x, other.x);
    box.y = std::min(box.y, other.y);
    box.width = right - box.x;
    box.height = bottom - box.y;
  };
  for (const PlacedText& text : layout.texts) include(text.box);
  for (const PlacedBar& bar : layout.bars) include(bar.box);
  for (const PlacedTrace& trace : layout.traces) include(trace.box);
  if (layout.arrow.width > 0.0) include(layout.arrow);
  return box;
}

bool overlap(const Box& a, const Box& b) {
  return a.x < b.right() && b.x < a.right() && a.y < b.bottom() && b.y < a.bottom();
}

void expect_apart(const Sheet& sheet) {
  for (std::size_t k = 0; k < sheet.views.size(); ++k) {
    const Box box = extent_of(sheet.views[k].layout);
    EXPECT_GE(box.x, 0.0);
    EXPECT_GE(box.y, 0.0);
    EXPECT_LE(box.right(), sheet.width);
    EXPECT_LE(box.bottom(), sheet.height);
    for (std::size_t other = 0; other < k; ++other)
      EXPECT_FALSE(overlap(box, extent_of(sheet.views[other].layout))) << k << " and " << other;
  }
}

TEST(Sheet, RowsStandBelowEachOtherWithLevelBeds) {
  FrameView longer = test::sample_view();
  longer.title = "A title that is much too long for its half of the sheet, so that it takes two lines";
  const std::vector<std::vector<FrameView>> rows = {{test::sample_view(), longer},
                                                    {test::sample_view(), test::sample_view()}};
  const Sheet sheet = sheet_of_rows(rows, 1600, embedded_font());
  ASSERT_EQ(sheet.views.size(), 4u);
  EXPECT_EQ(sheet.width, 1600);
  expect_apart(sheet);
  for (const std::size_t row : {0u, 2u})
    EXPECT_EQ(sheet.views[row].layout.bed.box.y, sheet.views[row + 1].layout.bed.box.y);
  for (const PlacedView& placed : sheet.views) EXPECT_EQ(placed.layout.em, sheet.views[0].layout.em);
  EXPECT_EQ(sheet.views[1].layout.bed.box.x - sheet.views[0].layout.bed.box.x, 800.0);
  // The camera moves with its window: the lower left corner of the bed is that of the window.
  const Window& bed = sheet.views[3].layout.bed;
  EXPECT_NEAR(bed.camera.project(bed.x_min, bed.y_min).x, bed.box.x, 1e-9);
  EXPECT_NEAR(bed.camera.project(bed.x_min, bed.y_min).y, bed.box.bottom(), 1e-9);
}

TEST(Sheet, AViewWithoutABedIsItsTextsAndCurves) {
  const Layout layout = lay_out(curves_alone(), 800, embedded_font());
  EXPECT_EQ(layout.bed.box.width, 0.0);
  EXPECT_EQ(layout.traces.size(), 2u);
}

TEST(Sheet, TypeThatWouldBeTooSmallIsRefused) {
  FrameView view = test::sample_view();
  view.title = "A-title-of-one-word-that-cannot-be-broken-into-lines-and-that-takes-a-much-smaller-type";
  view.letters = 40.0;
  EXPECT_NO_THROW(lay_out(view, 1600, embedded_font()));
  view.max_letters = 45.0;
  EXPECT_THROW(lay_out(view, 1600, embedded_font()), Error);
}

TEST(Arrangement, FillsAGivenSizeWithTheLargestBeds) {
  const Font font = embedded_font();
  for (const auto& [width, height] : {std::pair{1920, 1080}, {1080, 1920}, {1280, 720}}) {
    const std::vector<FrameView> views = {test::sample_view(100, 20), test::sample_view(100, 20),
                                          curves_alone()};
    const Arrangement arrangement = arrange({views, views}, width, height, font);
    const Sheet sheet = arranged(views, arrangement, font);
    EXPECT_EQ(sheet.width, width);
    EXPECT_EQ(sheet.height, height);
    expect_apart(sheet);
    EXPECT_GE(arrangement.cell, width / 3) << "at least as large as all views side by side";
  }
  const std::vector<FrameView> one = {test::sample_view(100, 20)};
  EXPECT_GT(arrange({one}, 1080, 1920, font).cell, 1050) << "as wide as the given size";
}

TEST(Arrangement, HoldsTheLongestTextOfAllFrames) {
  const Font font = embedded_font();
  std::vector<std::vector<FrameView>> frames(30, {test::sample_view(40, 20)});
  frames[17][0].title =
      "A title that is so long that it takes two lines, if the picture is not wide enough for it";
  const Arrangement arrangement = arrange(frames, 700, 500, font);
  for (const std::vector<FrameView>& views : frames) {
    const Sheet sheet = arranged(views, arrangement, font);
    expect_apart(sheet);
    EXPECT_EQ(sheet.views[0].layout.bed.box.y,
              arranged(frames[0], arrangement, font).views[0].layout.bed.box.y)
        << "the bed does not move";
  }
}

TEST(Arrangement, ThatCannotBeIsRefused) {
  const std::vector<FrameView> views = {test::sample_view(40, 30), test::sample_view(40, 30), curves_alone()};
  EXPECT_THROW(arrange({views}, 400, 200, embedded_font()), Error);
}

}  // namespace
}  // namespace talus::render
