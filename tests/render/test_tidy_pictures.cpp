/// No label is clipped or overlaps another, in every map and panel, for beds from one grain to 2500 D, at
/// every width. Most checks use the boxes of the layout; the boxes are checked by the ink of pictures.

#include <gtest/gtest.h>

#include <fmt/core.h>

#include "base/errors.h"
#include "pictures/traces.h"
#include "render/map_bed.h"
#include "render/renderer.h"
#include "render/tidy_layout.h"

namespace talus::render {
namespace {

using test::untidy;

/// A few touching grains spread over a bed of that size; a layout depends on the extent of the bed, and
/// hardly on its grains.
struct Bed {
  test::Packing packing;
  Frame before;
  pictures::MapExtent extent;
};

Bed bed_of(double length, double depth, Index pairs = 6) {
  Bed bed;
  bed.packing = test::empty_packing(length, true);
  for (Index k = 0; k < pairs; ++k) {
    const double x = (0.1 + k) * length / pairs;
    test::add_grain(bed.packing, x, 0.5, 0.5, {1.0, 0.3, 0.3, 0.5});
    if (pairs > 1) test::add_grain(bed.packing, x + 1.0, 0.5, 0.5, {1.0, 0.1, 0.1, 0.9});
  }
  for (Index k = 0; pairs > 1 && k < pairs; ++k) test::add_contact(bed.packing, 2 * k, 2 * k + 1, 2.0, 0.5);
  test::complete(bed.packing);
  test::gamma_from_moments(bed.packing);
  bed.packing.statics.depth = depth;
  bed.before = bed.packing.frame;
  bed.packing.frame.tilt = 0.36;
  bed.packing.frame.step += 100;
  for (std::size_t i = 0; i < bed.packing.frame.x.size(); ++i) bed.packing.frame.x[i] += 0.01 * (1.0 + i % 3);
  bed.extent = {0.0, length, -1.0, depth};
  return bed;
}

FrameView view_of(const Bed& bed, const pictures::MapSettings& settings) {
  return pictures::make_map({{bed.packing.frame, bed.packing.statics}, &bed.before, true, {}}, settings,
                            bed.extent);
}

/// Returns settings with the longest titles and captions.
pictures::MapSettings longest_settings(const std::string& layers) {
  pictures::MapSettings settings = test::settings_of(layers);
  settings.theta_c_assumed = true;
  settings.l_min = 2.25;
  settings.length = 5.5;
  return settings;
}

/// Returns the pictures that options make of a map: unchanged, turned, with traces, for print, and as the
/// upper part of a panel.
std::vector<std::pair<std::string, FrameView>> variants(const FrameView& plain,
                                                        const pictures::MapSettings& settings) {
  std::vector<std::pair<std::string, FrameView>> all = {{"plain", plain}};
  FrameView& turned = all.emplace_back("turned", plain).second;
  turned.turn = 0.36;
  turned.turn_max = 0.5;
  FrameView& traced = all.emplace_back("traced", plain).second;
  const std::vector<double> tilts = {-0.1, 0.1, 0.2, 0.36}, values = {0.31, -0.3521, 0.4, 0.6};
  for (const pictures::TraceKind trace : pictures::trace_kinds())
    traced.traces.push_back(pictures::make_trace(trace, tilts, values, settings, 0.36));
  FrameView& printed = all.emplace_back("printed", traced).second;
  printed.letters = 8.6 / 2.54 * 72.0 / 8.0;
  FrameView& part = all.emplace_back("part", plain).second;
  part.legends.clear();
  part.scale_label.clear();
  return all;
}

/// Expects a tidy layout with legible letters; a picture above the permitted height is rejected.
void expect_readable(const FrameView& view, int width, const std::string& what) {
  static const Font font = embedded_font();
  try {
    const Layout layout = lay_out(view, width, font);
    EXPECT_EQ(untidy(layout), "") << what;
    EXPECT_GE(layout.em, width < 300 ? 6.0 : 8.0) << what;
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("px high"), std::string::npos) << what << ": " << error.what();
  }
}

TEST(TidyPictures, of_every_map_of_every_bed_at_every_width) {
  for (const auto& [length, depth] :
       {std::pair{10.0, 3.0}, {10.0, 60.0}, {60.0, 30.0}, {200.0, 40.0}, {2500.0, 3.0}, {2500.0, 60.0}}) {
    const Bed bed = bed_of(length, depth);
    for (const pictures::MapKind kind : pictures::map_kinds()) {
      const pictures::MapSettings settings = longest_settings(std::string(pictures::map_name(kind)));
      for (const auto& [name, view] : variants(view_of(bed, settings), settings))
        for (const int width : {200, 300, 455, 1000, 1600, 16384})
          expect_readable(
              view, width,
              fmt::format("{} x {} D, {}, {}, {} px", length, depth, pictures::map_name(kind), name, width));
    }
  }
}

TEST(TidyPictures, of_every_overlay) {
  const Bed bed = bed_of(200.0, 40.0);
  for (const pictures::MapKind lower : pictures::map_kinds())
    for (const pictures::MapKind upper : pictures::map_kinds()) {
      if (lower == upper) continue;
      const std::string layers = fmt::format("{}+{}", pictures::map_name(lower), pictures::map_name(upper));
      const pictures::MapSettings settings = longest_settings(layers);
      const FrameView view = view_of(bed, settings);
      for (const FrameView& variant : {view, variants(view, settings)[2].second})  // plain, and with traces
        for (const int width : {200, 400, 1600})
          expect_readable(variant, width, fmt::format("{}, {} px", layers, width));
    }
}

TEST(TidyPictures, at_every_range_of_a_scale) {
  const Bed bed = bed_of(60.0, 20.0);
  for (const pictures::MapKind kind : pictures::map_kinds()) {
    if (!pictures::has_bar({kind})) continue;
    const std::string name(pictures::map_name(kind));
    const bool logarithmic = view_of(bed, longest_settings(name)).legends[0].bars[0].logarithmic;
    for (const auto& [low, high] : {std::pair{1e-12, 1e12},
                                    {1e-12, 1e-11},
                                    {3e-12, 4e-12},
                                    {0.3, 0.30001},
                                    {999999.0, 1000001.0},
                                    {1e11, 1e12},
                                    {-1e12, 1e12},
                                    {-2e-12, 1e-12}}) {
      if (logarithmic && low < 0.0) continue;
      pictures::MapSettings settings = longest_settings(name);
      settings.range_low = low;
      settings.range_high = high;
      const FrameView view = view_of(bed, settings);
      EXPECT_GE(view.legends[0].bars[0].ticks.size(), 2u) << name << " from " << low << " to " << high;
      for (const int width : {200, 400, 1600})
        expect_readable(view, width, fmt::format("{} from {} to {}, {} px", name, low, high, width));
    }
  }
}

TEST(TidyPictures, of_parts_of_a_bed) {
  Bed bed = bed_of(2500.0, 60.0);
  for (const auto& [length, depth] :
       {std::pair{0.1, 0.1}, {0.7, 3.0}, {2.0, 0.01}, {45.0, 16.0}, {2500.0, 1.0}}) {
    bed.extent = {1200.0, std::min(2500.0, 1200.0 + length), 0.0, depth};
    const pictures::MapSettings settings = longest_settings("coarse+forces");
    for (const auto& [name, view] : variants(view_of(bed, settings), settings))
      for (const int width : {200, 400, 1600})
        expect_readable(view, width, fmt::format("{} x {} D, {}, {} px", length, depth, name, width));
  }
}

TEST(TidyPictures, of_one_grain_and_of_many) {
  for (const Index pairs : {1, 50000}) {
    const Bed bed = pairs == 1 ? bed_of(10.0, 3.0, 1) : bed_of(2500.0, 60.0, pairs);
    for (const char* layers : {"gamma+forces", "clusters", "displacement", "size"})
      for (const int width : {200, 1600})
        expect_readable(view_of(bed, longest_settings(layers)), width,
                        fmt::format("{}, {} grains", layers, 2 * pairs));
  }
}

/// Returns rows of two maps at increasing angles, as in panels.
std::vector<std::vector<FrameView>> panel_of(const Bed& bed, const std::vector<std::string>& maps,
                                             bool turned, bool traced) {
  std::vector<std::vector<FrameView>> rows;
  for (const double tilt : {0.0, 0.17, 0.36}) {
    Bed at = bed;
    at.packing.frame.tilt = tilt;
    std::vector<FrameView>& row = rows.emplace_back();
    for (const std::string& name : maps) {
      pictures::MapSettings settings = longest_settings(name);
      settings.turned = turned;
      settings.tilt_max = 0.36;
      FrameView& view = row.emplace_back(view_of(at, settings));
      if (traced) view = variants(view, settings)[2].second;
      if (rows.size() > 1 && row.size() == 1) view.title.clear();
      if (tilt == 0.36) continue;
      view.scale_label.clear();
      view.legends.clear();
    }
  }
  return rows;
}

TEST(TidyPictures, of_panels_whose_rows_are_level) {
  const Font font = embedded_font();
  for (const auto& [length, depth] : {std::pair{60.0, 30.0}, {200.0, 40.0}, {10.0, 5.0}})
    for (const std::vector<std::string>& maps : {std::vector<std::string>{"gamma", "clusters"},
                                                 {"coarse+forces", "displacement", "temperature"},
                                                 {"dilation", "vorticity"}})
      for (const bool turned : {false, true})
        for (const bool traced : {false, true})
          for (const int width : {200, 400, 550, 800, 1600}) {
            std::vector<std::vector<FrameView>> rows = panel_of(bed_of(length, depth), maps, turned, traced);
            const std::vector<LayoutLimits> limits =
                level_rows(rows, width * static_cast<int>(maps.size()), font);
            for (std::size_t r = 0; r < rows.size(); ++r) {
              const Layout first = lay_out(rows[r][0], width, font, limits[r]);
              for (const FrameView& view : rows[r]) {
                const std::string what = fmt::format("{} D, {} maps, row {}, {} px{}", length, maps.size(), r,
                                                     width, turned ? ", turned" : "");
                const Layout layout = lay_out(view, width, font, limits[r]);
                EXPECT_EQ(untidy(layout), "") << what;
                EXPECT_EQ(layout.em, first.em) << what;
                EXPECT_EQ(layout.bed.box.y, first.bed.box.y) << what << ": the beds are not level";
                EXPECT_EQ(layout.bed.box.height, first.bed.box.height) << what;
                if (traced) {
                  EXPECT_EQ(layout.traces[0].box.y, first.traces[0].box.y) << what;
                }
              }
            }
          }
}

// Otherwise the columns of a panel would have letters of different sizes.
TEST(TidyPictures, letters_under_a_limit_have_the_size_of_the_limit) {
  const Font font = embedded_font();
  const Bed bed = bed_of(50.0, 20.0);
  for (const pictures::MapKind kind : pictures::map_kinds())
    for (int width = 300; width < 1000; width += 50) {
      FrameView view = view_of(bed, longest_settings(std::string(pictures::map_name(kind))));
      view.letters /= 2.0;
      LayoutLimits limits;
      for (const double less : {0.0, 1.0, 2.0}) {
        limits.largest_em = lay_out(view, width, font).em - less;
        EXPECT_EQ(lay_out(view, width, font, limits).em, limits.largest_em)
            << pictures::map_name(kind) << ", " << width << " px";
      }
    }
}

TEST(TidyPictures, panels_have_letters_that_go_by_the_width_of_all_columns) {
  const Font font = embedded_font();
  std::vector<std::vector<FrameView>> rows =
      panel_of(bed_of(60.0, 30.0), {"gamma", "displacement"}, false, false);
  const std::vector<LayoutLimits> limits = level_rows(rows, 1600 * static_cast<int>(rows[0].size()), font);
  EXPECT_EQ(lay_out(rows[0][0], 1600, font, limits[0]).em, 36.0) << "3200 px over 90";
}

TEST(TidyPictures, rows_of_a_turned_panel_are_as_high_as_their_turn) {
  const Font font = embedded_font();
  std::vector<std::vector<FrameView>> rows = panel_of(bed_of(200.0, 40.0), {"gamma"}, true, false);
  const std::vector<LayoutLimits> limits = level_rows(rows, 1600 * static_cast<int>(rows[0].size()), font);
  const Window flat = lay_out(rows[0][0], 1600, font, limits[0]).bed;
  const Window steep = lay_out(rows[2][0], 1600, font, limits[2]).bed;
  EXPECT_EQ(flat.camera.scale, steep.camera.scale);
  EXPECT_NEAR(flat.box.height, 41.0 * flat.camera.scale, 1.0);
  for (const Window& bed : {flat, steep})
    for (const double x : {bed.x_min, bed.x_max})
      for (const double y : {bed.y_min, bed.y_max}) {
        EXPECT_GE(bed.camera.project(x, y).y, bed.box.y - 1.0);
        EXPECT_LE(bed.camera.project(x, y).y, bed.box.bottom() + 1.0);
      }
}

/// Numbers of inked pixels outside all boxes of the layout, and at the very edges of a picture.
struct Ink {
  int outside = 0, at_edges = 0;
};

Ink ink_of(const Image& image, const Layout& layout) {
  std::vector<test::NamedBox> boxes = test::all_boxes(layout);
  boxes[0].box = test::grown(boxes[0].box, 2.0 * test::line_width(layout));  // walls and floor
  std::vector<std::uint8_t> covered(static_cast<std::size_t>(image.width) *
                                    static_cast<std::size_t>(image.height));
  for (const test::NamedBox& named : boxes) {
    const Box box = test::grown(named.box, 1.0);  // soft edges
    for (int y = std::max(0, static_cast<int>(box.y));
         y < std::min<int>(image.height, std::ceil(box.bottom())); ++y)
      for (int x = std::max(0, static_cast<int>(box.x));
           x < std::min<int>(image.width, std::ceil(box.right())); ++x)
        covered[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                static_cast<std::size_t>(x)] = 1;
  }
  Ink ink;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const std::size_t at =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x);
      bool inked = false;
      for (int channel = 0; channel < image.channels; ++channel)
        inked =
            inked ||
            image.pixels[at * static_cast<std::size_t>(image.channels) + static_cast<std::size_t>(channel)] <
                250;
      if (!inked) continue;
      ink.outside += covered[at] == 0;
      ink.at_edges += x == 0 || y == 0 || x + 1 == image.width || y + 1 == image.height;
    }
  return ink;
}

TEST(TidyPictures, the_ink_is_where_the_boxes_are) {
  Renderer renderer(make_context(std::nullopt));
  for (const auto& [length, depth] : {std::pair{10.0, 5.0}, {200.0, 40.0}})
    for (const char* layers : {"gamma+forces", "clusters+displacement", "dyed", "temperature"}) {
      const pictures::MapSettings settings = longest_settings(layers);
      for (const auto& [name, view] : variants(view_of(bed_of(length, depth), settings), settings))
        for (const int width : {200, 700}) {
          const Ink ink = ink_of(renderer.draw(view, width), lay_out(view, width, renderer.font()));
          EXPECT_EQ(ink.outside, 0) << layers << ", " << name << ", " << width << " px";
          EXPECT_EQ(ink.at_edges, 0) << layers << ", " << name << ", " << width << " px";
        }
    }
}

}  // namespace
}  // namespace talus::render
