/// Layouts of a view, and of several views in one picture.

#include <gtest/gtest.h>

#include <cmath>

#include "base/errors.h"
#include "render/furniture.h"
#include "render/layout.h"
#include "render/sample_view.h"
#include "render/sheet.h"
#include "render/tidy_layout.h"

namespace talus::render {
namespace {

using test::all_boxes;
using test::expect_tidy;
using test::full_view;
using test::overlap;
using test::sample_view;

const Font font = embedded_font();

/// Returns views with combinations of options: plain, with all elements, turned, and with parts omitted as in
/// a panel.
std::vector<std::pair<std::string, FrameView>> views_of(int columns, int rows) {
  FrameView turned = full_view(columns, rows);
  turned.turn = 0.2;
  turned.turn_max = 0.4;
  FrameView part = full_view(columns, rows);
  part.title.clear();
  part.scale_label.clear();
  part.legends.clear();
  part.traces.clear();
  return {{"plain", sample_view(columns, rows)},
          {"full", full_view(columns, rows)},
          {"turned", turned},
          {"part", part}};
}

TEST(Layout, NothingOverlapsAtAnyWidthInAnyBed) {
  for (auto [columns, rows] : {std::pair{200, 46}, {50, 10}, {20, 40}, {4, 3}})
    for (const auto& [name, view] : views_of(columns, rows))
      for (int width : {200, 320, 400, 801, 1600, 4000, 8000}) {
        if (width * (rows + columns) > 14000 * columns)
          continue;  // exceeds the permitted height of a picture
        expect_tidy(lay_out(view, width, font),
                    name + " of " + std::to_string(columns) + " columns at " + std::to_string(width) + " px");
      }
}

TEST(Layout, ShowsEverythingThatIsAskedFor) {
  for (int width : {200, 400, 1600, 8000}) {
    const Layout layout = lay_out(full_view(200, 46), width, font);
    EXPECT_EQ(layout.bars.size(), 1u);
    EXPECT_EQ(layout.swatches.size(), 3u);
    EXPECT_EQ(layout.traces.size(), 2u);
    EXPECT_GT(layout.scale_bar.width, 0.0);
    EXPECT_GT(layout.arrow.width, 0.0);
    for (const char* text : {"θ = 11.46°, θ_c = 20.05°", "10 D", "g", "γ = q/p", "2Γ_c = 0.69", "f_n > ⟨f_n⟩",
                             "spans floor to surface", "ΔV/V, volume strain", "θ (°)"}) {
      int count = 0;
      for (const PlacedText& placed : layout.texts) count += placed.text == text;
      EXPECT_EQ(count, 1) << text << " at " << width;
    }
  }
}

TEST(Layout, WithoutFurnitureTheBedFillsThePicture) {
  FrameView view = full_view(200, 46);
  view.furniture = false;
  const Layout layout = lay_out(view, 1600, font);
  const Box& bed = layout.bed.box;
  EXPECT_EQ(bed.x, 0.0);
  EXPECT_EQ(bed.y, 0.0);
  EXPECT_EQ(bed.width, 1600.0);
  EXPECT_EQ(layout.width, 1600);
  EXPECT_EQ(bed.height, layout.height);
  EXPECT_NEAR(layout.height, 1600.0 * (view.y_max - view.y_min) / (view.x_max - view.x_min), 1.0);
  const Point corner = layout.bed.camera.project(view.x_min, view.y_min);
  EXPECT_NEAR(corner.x, 0.0, 1e-9);
  EXPECT_NEAR(corner.y, layout.height, 1e-9);
  EXPECT_EQ(all_boxes(layout).size(), 1u);
  view.y_max = 100.0 * view.x_max;
  EXPECT_THROW(lay_out(view, 1600, font), Error);
}

TEST(Layout, HoldsTheWholeBedInItsAspect) {
  const FrameView view = sample_view(200, 46);
  const Layout layout = lay_out(view, 1600, font);
  const Box& bed = layout.bed.box;
  const Point low = layout.bed.camera.project(view.x_min, view.y_min);
  const Point high = layout.bed.camera.project(view.x_max, view.y_max);
  EXPECT_NEAR(low.x, bed.x, 1e-9);
  EXPECT_NEAR(low.y, bed.bottom(), 1e-9);
  EXPECT_NEAR(high.x, bed.right(), 1e-9);
  EXPECT_GE(high.y, bed.y - 1e-9);
  EXPECT_LT(high.y, bed.y + 1.0);
  EXPECT_NEAR(layout.scale_bar.width, layout.bed.camera.scale * 10 * 0.01, 0.5);  // 10 D
}

TEST(Layout, HasRoomForEveryTurnUpToTheLargest) {
  FrameView view = sample_view(60, 20);
  view.turn_max = 0.6;
  Box first;
  for (double turn : {0.0, 0.2, 0.45, 0.6}) {
    view.turn = turn;
    const Layout layout = lay_out(view, 900, font);
    const Box& box = layout.bed.box;
    if (turn == 0.0) first = box;
    EXPECT_EQ(box.x, first.x);
    EXPECT_EQ(box.height, first.height);
    for (double x : {view.x_min, view.x_max})
      for (double y : {view.y_min, view.y_max}) {
        const Point corner = layout.bed.camera.project(x, y);
        EXPECT_GE(corner.x, box.x - 1e-9) << turn;
        EXPECT_LE(corner.x, box.right() + 1e-9) << turn;
        EXPECT_GE(corner.y, box.y - 1e-9) << turn;
        EXPECT_LE(corner.y, box.bottom() + 1e-9) << turn;
      }
    // The bed falls to the right by its tilt, downslope.
    const Point a = layout.bed.camera.project(view.x_min, 0.0),
                b = layout.bed.camera.project(view.x_max, 0.0);
    EXPECT_NEAR(std::atan2(b.y - a.y, b.x - a.x), turn, 1e-9);
  }
}

TEST(Layout, TextShrinksBeforeItIsRefused) {
  FrameView view = sample_view();
  view.title = std::string(80, 'm');
  EXPECT_LT(lay_out(view, 600, font).em, 10.0);
  view.title = std::string(400, 'm');
  EXPECT_THROW(lay_out(view, 600, font), Error);
}

TEST(Layout, LettersAreAsLargeAsTheViewAsks) {
  FrameView view = sample_view();
  view.letters = 40.0;
  EXPECT_EQ(lay_out(view, 1600, font).em, 40.0);
  EXPECT_EQ(lay_out(view, 1600, font, {20.0}).em, 20.0);
  view.title = std::string(60, 'm');
  EXPECT_LT(lay_out(view, 1600, font).em, 30.0) << "otherwise the title would not fit";
}

TEST(Layout, KeepsToTheFontSizeAllowed) {
  EXPECT_EQ(lay_out(sample_view(), 1600, font).em, 18.0);
  EXPECT_EQ(lay_out(sample_view(), 1600, font, {11.5}).em, 11.5);
  EXPECT_EQ(lay_out(sample_view(), 1600, font, {40.0}).em, 18.0);
}

TEST(Layout, RefusesPicturesThatAreTooSmallOrTooLarge) {
  FrameView view = sample_view();
  EXPECT_THROW(lay_out(view, smallest_width - 1, font), Error);
  EXPECT_THROW(lay_out(view, largest_side + 1, font), Error);
  view.y_max = 100.0 * view.x_max;
  EXPECT_THROW(lay_out(view, 1600, font), Error);
}

TEST(Layout, TracesStandWhereTheirValuesAre) {
  const Layout layout = lay_out(full_view(), 1600, font);
  const PlacedTrace& trace = layout.traces.at(0);
  const Box& box = trace.box;
  const Trace sample = test::sample_trace("");
  EXPECT_NEAR(trace.mark.x, box.x + box.width * sample.mark / 20.0, 1e-9);
  const double between = 0.5 * (sample.y[45] + sample.y[46]);  // midpoint, at 11.375
  const double slope = (sample.y[46] - sample.y[45]) / 0.25;
  EXPECT_NEAR(trace.mark.y, box.bottom() - box.height * (between + slope * (11.46 - 11.375)) / 2.0, 1e-9);
  EXPECT_NEAR(trace.event, box.x + box.width * 19.0 / 20.0, 1e-9);
  EXPECT_NEAR(trace.curve.at(80).x, box.right(), 1e-9);
  EXPECT_NEAR(trace.curve.at(0).y, box.bottom() - box.height * 0.05, 1e-9);
  EXPECT_NEAR(trace.x_ticks.at(1), box.x + 0.25 * box.width, 1e-9);
  EXPECT_NEAR(trace.y_ticks.at(4), box.y, 1e-9);
}

TEST(Layout, LeavesOutLabelsOfTracesThatWouldTouch) {
  FrameView view = sample_view();
  Trace crowded = test::sample_trace("ΔV/V, volume strain");
  for (int k = 0; k <= 20; ++k) {
    crowded.x_ticks.push_back({1.0 * k, std::to_string(1000 + k)});
    crowded.y_ticks.push_back({0.1 * k, std::to_string(k)});
  }
  crowded.event = 1.0;  // above the title
  view.traces = {crowded};
  for (int width : {400, 1600}) {
    const Layout layout = lay_out(view, width, font);
    expect_tidy(layout, std::to_string(width) + " px");
    for (const PlacedText& text : layout.texts) EXPECT_NE(text.text, "θ_c");
  }
}

TEST(Layout, ATraceMayBeEmptyFlatOrBroken) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  FrameView view = sample_view();
  Trace none, flat = test::sample_trace("flat"), broken = test::sample_trace("broken");
  none.mark = 0.5;
  flat.y_min = flat.y_max = flat.y[0];
  broken.y[45] = broken.y[46] = nan;
  view.traces = {none, flat, broken};
  const Layout layout = lay_out(view, 1600, font);
  EXPECT_TRUE(std::isnan(layout.traces.at(0).mark.y));
  EXPECT_NEAR(layout.traces.at(1).curve.at(0).y, layout.traces[1].box.y + 0.5 * layout.traces[1].box.height,
              1e-9);
  EXPECT_TRUE(std::isnan(layout.traces.at(2).mark.y));
  const Furniture furniture = furnish(view, layout);
  for (const Line& line : furniture.lines) EXPECT_TRUE(std::isfinite(line.y0) && std::isfinite(line.y1));
  for (const Disc& disc : furniture.discs) EXPECT_TRUE(std::isfinite(disc.y));
}

TEST(Layout, GravityArrowPointsAlongGravity) {
  for (double turn : {0.0, 0.1, 0.3}) {
    FrameView view = sample_view();
    view.tilt = 0.3;
    view.turn = turn;
    view.turn_max = turn;
    const Layout layout = lay_out(view, 1600, font);
    const Line shaft = furnish(view, layout).lines.at(0);
    EXPECT_NEAR(std::atan2(shaft.x1 - shaft.x0, shaft.y0 - shaft.y1), view.tilt - turn, 1e-5);  // y upwards
  }
}

FrameView curves_alone() {
  FrameView view;
  view.letters = sample_view().letters;
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
  FrameView longer = sample_view();
  longer.title = "A title that is much too long for its half of the sheet, so that it takes two lines";
  const std::vector<std::vector<FrameView>> rows = {{sample_view(), longer}, {sample_view(), sample_view()}};
  const Sheet sheet = sheet_of_rows(rows, 1600, font);
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
  const Layout layout = lay_out(curves_alone(), 800, font);
  EXPECT_EQ(layout.bed.box.width, 0.0);
  EXPECT_EQ(layout.traces.size(), 2u);
}

TEST(Sheet, TypeThatWouldBeTooSmallIsRefused) {
  FrameView view = sample_view();
  view.title = "A-title-of-one-word-that-cannot-be-broken-into-lines-and-that-takes-a-much-smaller-type";
  view.letters = 40.0;
  EXPECT_NO_THROW(lay_out(view, 1600, font));
  view.max_letters = 45.0;
  EXPECT_THROW(lay_out(view, 1600, font), Error);
}

TEST(Arrangement, FillsAGivenSizeWithTheLargestBeds) {
  for (const auto& [width, height] : {std::pair{1920, 1080}, {1080, 1920}, {1280, 720}}) {
    const std::vector<FrameView> views = {sample_view(100, 20), sample_view(100, 20), curves_alone()};
    const Arrangement arrangement = arrange({views, views}, width, height, font);
    const Sheet sheet = arranged(views, arrangement, font);
    EXPECT_EQ(sheet.width, width);
    EXPECT_EQ(sheet.height, height);
    expect_apart(sheet);
    EXPECT_GE(arrangement.cell, width / 3) << "at least as large as all views side by side";
  }
  const std::vector<FrameView> one = {sample_view(100, 20)};
  EXPECT_GT(arrange({one}, 1080, 1920, font).cell, 1050) << "as wide as the given size";
}

TEST(Arrangement, StacksACurveBelowALongBed) {
  const std::vector<FrameView> views = {sample_view(40, 10), curves_alone()};
  const Arrangement arrangement = arrange({views}, 1920, 1080, font);
  EXPECT_GT(arrangement.cell, 1800) << "nearly as wide as the movie, not half of it";
  const Sheet sheet = arranged(views, arrangement, font);
  const std::vector<PlacedTrace>& traces = sheet.views[1].layout.traces;
  EXPECT_GT(traces[0].box.height, 0.0);
  const std::vector<FrameView> tall = {sample_view(40, 10), curves_alone()};
  const Sheet poster = arranged(tall, arrange({tall}, 1080, 1920, font), font);
  EXPECT_GT(poster.views[1].layout.traces[0].box.height, 8.0 * poster.views[1].layout.em)
      << "curves take the room that is left";
}

TEST(Sheet, ATurnedRowMovesUpAlongTheSlopeOfTheOneAbove) {
  FrameView turned = sample_view(40, 5);
  turned.scale_label.clear();
  turned.legends.clear();
  turned.title = "(a)";
  turned.turn = turned.turn_max = 0.35;
  const Sheet sheet = sheet_of_rows({{turned}, {turned}}, 1600, font);
  const Box &above = sheet.views[0].layout.bed.box, &below = sheet.views[1].layout.bed.box;
  EXPECT_LT(below.y, above.bottom()) << "their boxes overlap";
  EXPECT_GT(room_between(sheet.views[0].layout, sheet.views[1].layout, 1600), 0.0) << "the beds do not";
}

TEST(Layout, TheArrowOfGravityIsBesideTheCaptionOrTheScaleBar) {
  FrameView view = sample_view();
  const Layout below = lay_out(view, 1600, font);
  EXPECT_GT(below.arrow.y, below.bed.box.bottom());
  view.arrow_in_caption = true;
  const Layout above = lay_out(view, 1600, font);
  EXPECT_LT(above.arrow.bottom(), above.bed.box.y);
}

TEST(Arrangement, HoldsTheLongestTextOfAllFrames) {
  std::vector<std::vector<FrameView>> frames(30, {sample_view(40, 20)});
  frames[17][0].title =
      "A title that is so long that it takes two lines, if the picture is not wide enough for it";
  const Arrangement arrangement = arrange(frames, 700, 500, font);
  for (const std::vector<FrameView>& views : frames) {
    const Sheet sheet = arranged(views, arrangement, font);
    expect_apart(sheet);
    EXPECT_EQ(sheet.views[0].layout.bed.box.y,
              arranged(frames[0], arrangement, font).views[0].layout.bed.box.y)
        << "the bed does not move";
    const auto caption_of = [&](const std::vector<FrameView>& of) {
      return std::ranges::find(arranged(of, arrangement, font).views[0].layout.texts, of[0].caption,
                               &PlacedText::text)
          ->box.y;
    };
    EXPECT_EQ(caption_of(views), caption_of(frames[0])) << "nor does the caption";
  }
}

TEST(Arrangement, ThatCannotBeIsRefused) {
  const std::vector<FrameView> views = {sample_view(40, 30), sample_view(40, 30), curves_alone()};
  EXPECT_THROW(arrange({views}, 400, 200, font), Error);
}

}  // namespace
}  // namespace talus::render
