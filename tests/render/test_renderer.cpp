#include <cairo/cairo.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/errors.h"
#include "render/gl_objects.h"
#include "render/golden_picture.h"
#include "render/renderer.h"
#include "render/sample_view.h"
#include "render/target.h"
#include "support/exit_code.h"

namespace talus::render {
namespace {

using test::full_view;
using test::sample_view;

/// Requests of a target that draws nothing, for tests without OpenGL.
struct Recording {
  int width = 0, height = 0, begun = 0, ended = 0;
  PixelFormat format = PixelFormat::gray;
  std::vector<std::vector<Disc>> discs;  ///< one entry per draw, in order
  std::vector<std::vector<Line>> lines;
  std::vector<Window> disc_windows, line_windows;
  std::vector<Area> areas;
  std::vector<PlacedText> texts;
};

/// Fills the recording of its owner; its pictures are blank.
class RecordingTarget final : public ImageTarget {
 public:
  explicit RecordingTarget(Recording& recording) : recording_(recording) {}

  void begin(int width, int height, PixelFormat format) override {
    const int begun = recording_.begun + 1, ended = recording_.ended;
    recording_ = {};
    recording_.width = width;
    recording_.height = height;
    recording_.format = format;
    recording_.begun = begun;
    recording_.ended = ended;
  }
  void draw_discs(std::span<const Disc> discs, const Window& window) override {
    recording_.discs.emplace_back(discs.begin(), discs.end());
    recording_.disc_windows.push_back(window);
  }
  void draw_lines(std::span<const Line> lines, const Window& window) override {
    recording_.lines.emplace_back(lines.begin(), lines.end());
    recording_.line_windows.push_back(window);
  }
  void draw_areas(std::span<const Area> areas) override {
    recording_.areas.insert(recording_.areas.end(), areas.begin(), areas.end());
  }
  void draw_texts(std::span<const PlacedText> texts, double) override {
    recording_.texts.insert(recording_.texts.end(), texts.begin(), texts.end());
  }
  Image end() override {
    ++recording_.ended;
    const int channels = recording_.format == PixelFormat::gray     ? 1
                         : recording_.format == PixelFormat::colour ? 3
                                                                    : 4;
    Image image{recording_.width, recording_.height, channels, {}};
    image.pixels.assign(image.row_bytes() * static_cast<std::size_t>(image.height), 255);
    return image;
  }

 private:
  Recording& recording_;
};

/// Returns the pixel at (x, y) as a colour.
Colour pixel(const Image& image, double x, double y) {
  const std::size_t place =
      static_cast<std::size_t>(std::floor(y)) * image.row_bytes() +
      static_cast<std::size_t>(std::floor(x)) * static_cast<std::size_t>(image.channels);
  const std::uint8_t* at = image.pixels.data() + place;
  if (image.channels == 1) return {*at, *at, *at, 255};
  return {at[0], at[1], at[2], image.channels == 4 ? at[3] : std::uint8_t{255}};
}

int gray_at(const Image& image, double x, double y) { return pixel(image, x, y).red; }

/// Returns a bed of 10 x 4 m with the given discs, and with legend, title and caption.
FrameView view_of(std::vector<Disc> discs) {
  FrameView view = sample_view();
  view.discs = std::move(discs);
  view.x_max = 10.0;
  view.y_max = 4.0;
  view.scale_length = 1.0;
  return view;
}

Disc shaded(float x, float y, double shade) {
  return {x, y, 1.0f, gray(shade), gray(std::max(shade, 0.45)), 0.0f};
}

Renderer renderer_in_memory() { return Renderer(make_context(std::nullopt)); }

/// Picture of 1000 px whose pixels are found by places in the bed.
struct DrawnBed {
  DrawnBed(Renderer& renderer, const FrameView& view)
      : image(renderer.draw(view, 1000)), camera(lay_out(view, 1000, renderer.font()).bed.camera) {}

  Colour colour(double x, double y, int rows_below = 0) const {
    const Point place = camera.project(x, y);
    return pixel(image, place.x, place.y + rows_below);
  }
  int gray(double x, double y, int rows_below = 0) const { return colour(x, y, rows_below).red; }

  Image image;
  Camera camera;
};

class RendererTest : public testing::Test {
 protected:
  Renderer renderer_ = renderer_in_memory();
};

TEST_F(RendererTest, FillsDiscsWithTheirColour) {
  const Colour orange{230, 120, 10, 255};
  const FrameView view = view_of({shaded(2, 2, 0.0), {5, 2, 1, orange, black, 0.0f}, shaded(8, 2, 1.0)});
  const DrawnBed drawn(renderer_, view);
  EXPECT_EQ(drawn.image.channels, 3);
  EXPECT_EQ(drawn.colour(2, 2), white);
  EXPECT_EQ(drawn.colour(5, 2), orange);
  EXPECT_EQ(drawn.colour(5, 2.99), black) << "the rim";
  EXPECT_EQ(drawn.colour(8, 2), black);
  EXPECT_EQ(drawn.colour(8, 2.98), black);
  EXPECT_EQ(drawn.colour(8, 3.02), white);
  EXPECT_EQ(drawn.colour(3.5, 2), white);
  EXPECT_LT(drawn.colour(2, 2.99).red, 200) << "a white disc is visible by its rim";
}

TEST_F(RendererTest, TakesOneChannelWhereAllIsGray) {
  FrameView view = view_of({shaded(2, 2, 0.5)});
  const Image gray_image = renderer_.draw(view, 600);
  EXPECT_EQ(gray_image.channels, 1);
  view.coloured = true;
  const Image image = renderer_.draw(view, 600);
  ASSERT_EQ(image.channels, 3);
  for (std::size_t k = 0; k < gray_image.pixels.size(); ++k)
    for (std::size_t channel = 0; channel < 3; ++channel)
      ASSERT_NEAR(image.pixels[3 * k + channel], gray_image.pixels[k], 1) << k;  // blending rounds
}

TEST_F(RendererTest, CutsDiscsAndLinesAtTheEdgesOfTheBed) {
  FrameView view = view_of({shaded(0, 2, 1.0), shaded(10, 2, 1.0), shaded(5, 4, 1.0)});
  view.lines = {{-1, 1, 11, 1, 0.1f, black}};
  const Image image = renderer_.draw(view, 1000);
  const Window bed = lay_out(view, 1000, renderer_.font()).bed;
  for (double y : {2.0, 1.0}) {
    const double row = bed.camera.project(0, y).y;
    EXPECT_EQ(gray_at(image, bed.box.x, row), 0);
    EXPECT_EQ(gray_at(image, bed.box.x - 1, row), 255);
    EXPECT_EQ(gray_at(image, bed.box.right() - 1, row), 0);
    EXPECT_EQ(gray_at(image, bed.box.right(), row), 255);
  }
  EXPECT_EQ(gray_at(image, bed.box.x + 0.5 * bed.box.width, bed.box.y - 1), 255);
}

TEST_F(RendererTest, CutsATurnedBedAtItsOwnEdges) {
  FrameView view = view_of({shaded(0, 2, 1.0), shaded(10, 2, 1.0), shaded(5, 4, 1.0)});
  view.lines = {{-1, 1, 11, 1, 0.1f, black}};
  view.turn = view.turn_max = 0.4;
  const DrawnBed drawn(renderer_, view);
  for (double y : {2.0, 1.0}) {
    EXPECT_EQ(drawn.gray(0.05, y), 0);
    EXPECT_EQ(drawn.gray(-0.05, y), 255);
    EXPECT_EQ(drawn.gray(9.95, y), 0);
    EXPECT_EQ(drawn.gray(10.05, y), 255);
  }
  EXPECT_EQ(drawn.gray(5, 3.95), 0);
  EXPECT_EQ(drawn.gray(5, 4.05), 255);
}

TEST_F(RendererTest, DrawsLinesAboveDiscsInTheirWidth) {
  FrameView view = view_of({shaded(5, 2, 0.0)});
  view.lines = {{4, 2, 6, 2, 0.2f, gray(0.8)}, {1, 0.5f, 9, 0.5f, 0.0f, black}};
  const DrawnBed drawn(renderer_, view);
  EXPECT_EQ(drawn.gray(5, 2), 51);
  EXPECT_EQ(drawn.gray(5, 2.18), 51);
  EXPECT_EQ(drawn.gray(5, 2.23), 255);
  EXPECT_EQ(drawn.gray(6.15, 2), 51) << "round ends";
  double ink = 0.0;  // across the thin line, px
  for (int row = -3; row <= 3; ++row) ink += 1.0 - drawn.gray(3, 0.5, row) / 255.0;
  EXPECT_NEAR(ink, 0.7, 0.2) << "no line is too thin to be visible";
}

TEST_F(RendererTest, DrawsTheBedAloneWithoutFurniture) {
  FrameView view = view_of({shaded(0, 2, 1.0)});
  view.furniture = false;
  view.left_wall = view.right_wall = view.floor_line = true;
  view.traces = {test::sample_trace("p_o")};
  const Image image = renderer_.draw(view, 1000);
  ASSERT_EQ(image.width, 1000);
  ASSERT_EQ(image.height, 400);
  EXPECT_EQ(gray_at(image, 0, 200), 0);
  int strays = 0;
  for (int y = 0; y < 400; ++y)
    for (int x = 0; x < 1000; ++x) strays += gray_at(image, x, y) < 255 && std::hypot(x, y - 200) > 102.0;
  EXPECT_EQ(strays, 0) << "only the disc";
}

TEST_F(RendererTest, DrawsWallsAndFloorOutsideTheBed) {
  FrameView view = view_of({});
  view.left_wall = view.right_wall = view.floor_line = true;
  const Image image = renderer_.draw(view, 1000);
  const Box bed = lay_out(view, 1000, renderer_.font()).bed.box;
  const double middle = bed.y + 0.5 * bed.height;
  EXPECT_EQ(gray_at(image, bed.x, middle), 255);
  EXPECT_EQ(gray_at(image, bed.x - 1, middle), 0);
  EXPECT_EQ(gray_at(image, bed.right(), middle), 0);
  EXPECT_EQ(gray_at(image, bed.x + 5, bed.bottom()), 0);
  view.left_wall = false;
  EXPECT_EQ(gray_at(renderer_.draw(view, 1000), bed.x - 1, middle), 255);
}

TEST_F(RendererTest, BarRunsThroughItsColours) {
  for (ColourMap map : {ColourMap::gray, ColourMap::viridis, ColourMap::diverging}) {
    const FrameView view = sample_view(40, 10, map);
    const Image image = renderer_.draw(view, 1000);
    const Box bar = lay_out(view, 1000, renderer_.font()).bars.at(0).box;
    const double y = bar.y + 0.5 * bar.height;
    for (double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      const Colour seen = pixel(image, bar.x + share * (bar.width - 1.0), y), wanted = colour_at(map, share);
      EXPECT_NEAR(seen.red, wanted.red, 4) << share;
      EXPECT_NEAR(seen.green, wanted.green, 4) << share;
      EXPECT_NEAR(seen.blue, wanted.blue, 4) << share;
    }
  }
}

TEST_F(RendererTest, EveryTextLeavesInk) {
  for (int width : {400, 1600}) {
    const FrameView view = full_view();
    const Image image = renderer_.draw(view, width);
    for (const PlacedText& text : lay_out(view, width, renderer_.font()).texts) {
      int darkest = 255;
      for (double y = text.box.y; y < text.box.bottom(); y += 1.0)
        for (double x = text.box.x; x < text.box.right(); x += 1.0)
          darkest = std::min(darkest, gray_at(image, x, y));
      EXPECT_LT(darkest, 64) << text.text;
    }
  }
}

TEST_F(RendererTest, MarksTheFrameOnItsTrace) {
  FrameView view = sample_view();
  view.traces = {test::sample_trace("p_o")};
  const Image image = renderer_.draw(view, 1600);
  const PlacedTrace trace = lay_out(view, 1600, renderer_.font()).traces.at(0);
  EXPECT_EQ(gray_at(image, trace.mark.x, trace.mark.y), 0);
  EXPECT_LT(gray_at(image, trace.event, trace.box.y + 2.0), 64) << "the dashes at the event";
  EXPECT_LT(gray_at(image, trace.curve.at(20).x, trace.curve.at(20).y), 64) << "the curve";
  EXPECT_EQ(gray_at(image, trace.curve.at(20).x, trace.curve.at(20).y - 20.0), 255);
}

TEST_F(RendererTest, ClearGroundUnderTheSamePicture) {
  FrameView view = full_view();
  view.turn = view.turn_max = 0.1;
  const Image opaque = renderer_.draw(view, 700);
  view.transparent = true;
  const Image clear = renderer_.draw(view, 700);
  ASSERT_EQ(clear.channels, 4);
  EXPECT_EQ(pixel(clear, 1, 1).alpha, 0);
  int worst = 0, nothing = 0;
  for (int y = 0; y < clear.height; ++y)
    for (int x = 0; x < clear.width; ++x) {
      const Colour front = pixel(clear, x, y), seen = pixel(opaque, x, y);
      nothing += front.alpha == 0;
      const auto over_white = [&](int channel) {
        return channel * front.alpha / 255.0 + 255.0 - front.alpha;
      };
      worst = std::max({worst, static_cast<int>(std::abs(over_white(front.red) - seen.red)),
                        static_cast<int>(std::abs(over_white(front.green) - seen.green)),
                        static_cast<int>(std::abs(over_white(front.blue) - seen.blue))});
    }
  EXPECT_LE(worst, 2) << "on white paper it equals the opaque one";
  EXPECT_GT(nothing, clear.width * clear.height / 10);
}

/// Returns the expected picture of a view's bed: discs with their rims as filled by cairo.
std::vector<Colour> drawn_by_cairo(const FrameView& view, const Window& bed) {
  const int width = static_cast<int>(bed.box.width), height = static_cast<int>(bed.box.height);
  cairo_surface_t* surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
  cairo_t* cairo = cairo_create(surface);
  cairo_set_source_rgb(cairo, 1, 1, 1);
  cairo_paint(cairo);
  const Camera& camera = bed.camera;
  const auto corner = [&](double x, double y) {
    const Point place = camera.project(x, y);
    return Point{place.x - bed.box.x, place.y - bed.box.y};
  };
  for (auto [x, y] : {std::pair{bed.x_min, bed.y_min},
                      {bed.x_max, bed.y_min},
                      {bed.x_max, bed.y_max},
                      {bed.x_min, bed.y_max}})
    cairo_line_to(cairo, corner(x, y).x, corner(x, y).y);
  cairo_clip(cairo);
  const auto fill_disc = [&](const Disc& disc, double radius, const Colour& colour) {
    cairo_set_source_rgb(cairo, colour.red / 255.0, colour.green / 255.0, colour.blue / 255.0);
    const Point centre = corner(static_cast<double>(disc.x), static_cast<double>(disc.y));
    cairo_arc(cairo, centre.x, centre.y, radius, 0, 2 * 3.14159265358979);
    cairo_fill(cairo);
  };
  for (const Disc& disc : view.discs) {
    const double radius = camera.scale * static_cast<double>(disc.radius);
    fill_disc(disc, radius, disc.rim);
    fill_disc(disc, radius - std::min(0.18 * radius, 2.0), disc.fill);
  }
  for (const Line& line : view.lines) {
    const Point from = corner(static_cast<double>(line.x0), static_cast<double>(line.y0));
    const Point to = corner(static_cast<double>(line.x1), static_cast<double>(line.y1));
    cairo_set_source_rgb(cairo, line.colour.red / 255.0, line.colour.green / 255.0, line.colour.blue / 255.0);
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
    cairo_set_line_width(cairo, 2.0 * std::max(0.35, camera.scale * static_cast<double>(line.half_width)));
    cairo_move_to(cairo, from.x, from.y);
    cairo_line_to(cairo, to.x, to.y);
    cairo_stroke(cairo);
  }
  cairo_surface_flush(surface);
  const unsigned char* data = cairo_image_surface_get_data(surface);
  std::vector<Colour> pixels;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const unsigned char* at = data + y * cairo_image_surface_get_stride(surface) + 4 * x;
      pixels.push_back({at[2], at[1], at[0], 255});
    }
  cairo_destroy(cairo);
  cairo_surface_destroy(surface);
  return pixels;
}

/// Returns the mean absolute difference between the bed and cairo's drawing, as a share of the range.
double difference_to_cairo(const FrameView& view, int width) {
  Renderer renderer = renderer_in_memory();
  const Image image = renderer.draw(view, width);
  const Window bed = lay_out(view, width, renderer.font()).bed;
  const std::vector<Colour> wanted = drawn_by_cairo(view, bed);
  double sum = 0.0;
  std::size_t k = 0;
  for (double y = bed.box.y; y < bed.box.bottom(); y += 1.0)
    for (double x = bed.box.x; x < bed.box.right(); x += 1.0, ++k) {
      const Colour seen = pixel(image, x, y);
      sum += std::abs(seen.red - wanted[k].red) + std::abs(seen.green - wanted[k].green) +
             std::abs(seen.blue - wanted[k].blue);
    }
  return sum / (3.0 * 255.0 * static_cast<double>(k));
}

FrameView for_cairo(FrameView view) {
  for (Disc& disc : view.discs) disc.hatched = 0.0f;
  view.left_wall = view.right_wall = false;
  return view;
}

TEST(Renderer, AgreesWithCairo) {
  for (int width : {400, 1600}) {
    EXPECT_LT(difference_to_cairo(for_cairo(sample_view(60, 12)), width), 0.01) << width << " px, gray";
    FrameView full = for_cairo(full_view(60, 12));
    EXPECT_LT(difference_to_cairo(full, width), 0.01) << width << " px, colour and lines";
    full.turn = full.turn_max = 0.3;
    EXPECT_LT(difference_to_cairo(full, width), 0.01) << width << " px, turned";
  }
}

TEST(Renderer, SixteenMegapixelsHaveNoSeams) {
  FrameView view = for_cairo(sample_view(80, 20));
  view.furniture = false;
  EXPECT_LT(difference_to_cairo(view, 8000), 0.01);
}

TEST(Renderer, DrawsTheSameBitsAgain) {
  const FrameView view = full_view();
  std::vector<std::uint8_t> first;
  for (int context = 0; context < 2; ++context) {
    Renderer renderer = renderer_in_memory();
    renderer.draw(sample_view(), 640);  // earlier drawings leave no trace
    const Image image = renderer.draw(view, 800);
    if (context == 0) first = image.pixels;
    EXPECT_EQ(image.pixels, first);
    EXPECT_EQ(renderer.draw(view, 800).pixels, first);
  }
}

TEST(Renderer, AsksItsTargetForOneWholePicture) {
  Recording recording;
  Renderer renderer(std::make_unique<RecordingTarget>(recording));
  FrameView view = full_view();
  const Image image = renderer.draw(view, 800);
  const Layout layout = lay_out(view, 800, renderer.font());
  EXPECT_EQ(image.width, 800);
  EXPECT_EQ(image.height, layout.height);
  EXPECT_EQ(recording.begun, 1);
  EXPECT_EQ(recording.ended, 1);
  EXPECT_EQ(recording.format, PixelFormat::colour);
  ASSERT_EQ(recording.discs.size(), 2u) << "the bed, and the other elements";
  EXPECT_EQ(recording.discs[0].size(), view.discs.size());
  EXPECT_EQ(recording.disc_windows[0].box.x, layout.bed.box.x);
  EXPECT_EQ(recording.disc_windows[0].x_max, view.x_max);
  EXPECT_EQ(recording.discs[1].size(), 3u) << "one swatch, and the marks of two traces";
  ASSERT_EQ(recording.lines.size(), 2u);
  EXPECT_EQ(recording.lines[0].size(), view.lines.size());
  EXPECT_EQ(recording.disc_windows[1].box.height, layout.height);
  EXPECT_FALSE(recording.areas.empty());
  EXPECT_EQ(recording.texts.size(), layout.texts.size());

  view.furniture = false;
  view.transparent = true;
  renderer.draw(view, 800);
  EXPECT_EQ(recording.format, PixelFormat::transparent);
  EXPECT_EQ(recording.discs.size(), 1u);
  EXPECT_TRUE(recording.texts.empty());
}

TEST_F(RendererTest, LooksAsBefore) {
  FrameView turned = full_view(60, 12);
  turned.turn = 0.15;
  turned.turn_max = 0.2;
  test::expect_golden(renderer_.draw(sample_view(60, 12), 400), "picture_plain");
  test::expect_golden(renderer_.draw(full_view(60, 12), 400), "picture_full");
  test::expect_golden(renderer_.draw(turned, 400), "picture_turned");
}

TEST(GlObjects, SayWhichShaderDoesNotCompile) {
  const std::unique_ptr<Context> context = make_context(std::nullopt);
  const Gl gl = load_gl(*context);
  const std::string good = "#version 330 core\nvoid main() { gl_Position = vec4(0.0); }\n";
  const std::string bad = "#version 330 core\nvoid main() { no such thing; }\n";
  const auto bytes = [](const std::string& text) {
    return std::span(reinterpret_cast<const unsigned char*>(text.data()), text.size());
  };
  EXPECT_TRUE(test::refuses([&] { make_program(gl, "try", bytes(bad), bytes(good)); }, ExitCode::unavailable,
                            {"try.vert"}));
  EXPECT_TRUE(test::refuses([&] { make_program(gl, "try", bytes(good), bytes(bad)); }, ExitCode::unavailable,
                            {"try.frag"}));
}

}  // namespace
}  // namespace talus::render
