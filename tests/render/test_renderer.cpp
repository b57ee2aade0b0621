#include <cairo/cairo.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <set>

#include "render/png.h"
#include "render/read_png.h"
#include "render/renderer.h"
#include "render/synthetic_view.h"

namespace talus {
namespace {

using test::synthetic_view;

int gray_at(const Image& image, double x, double y) {
  return image.gray[static_cast<std::size_t>(std::floor(y)) * static_cast<std::size_t>(image.width) +
                    static_cast<std::size_t>(std::floor(x))];
}

/// A bed of 10 x 4 m with the discs given and the furniture of a map.
FrameView view_of(std::vector<Disc> discs) {
  FrameView view = synthetic_view(MapKind::gamma);
  view.discs = std::move(discs);
  view.x_max = 10.0;
  view.y_min = 0.0;
  view.y_max = 4.0;
  view.scale_length = 1.0;
  return view;
}

/// Mean absolute difference as a share of the range.
double mean_difference(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += std::abs(int{a[k]} - int{b[k]});
  return sum / (255.0 * static_cast<double>(a.size()));
}

TEST(Renderer, FillsDiscsWithTheirShade) {
  Renderer renderer(make_osmesa_context());
  const FrameView view = view_of({{2, 2, 1, 0.0f}, {5, 2, 1, 0.5f}, {8, 2, 1, 1.0f}});
  const Image image = renderer.draw(view, 1000);
  const Camera camera = lay_out(view, 1000, embedded_font()).camera;
  const auto at = [&](double x, double y) {
    return gray_at(image, camera.origin_x + camera.scale * x, camera.origin_y - camera.scale * y);
  };
  EXPECT_EQ(at(2, 2), 255);
  EXPECT_NEAR(at(5, 2), 128, 1);
  EXPECT_EQ(at(8, 2), 0);
  EXPECT_EQ(at(8, 2.98), 0);
  EXPECT_EQ(at(8, 3.02), 255);
  EXPECT_EQ(at(3.5, 2), 255);
  EXPECT_LT(at(2, 2.99), 200) << "a white disc shows its outline";
}

TEST(Renderer, CutsDiscsAtTheEdgesOfTheBed) {
  Renderer renderer(make_osmesa_context());
  const FrameView view = view_of({{0, 2, 1, 1.0f}, {10, 2, 1, 1.0f}, {5, 4, 1, 1.0f}});
  const Image image = renderer.draw(view, 1000);
  const Layout layout = lay_out(view, 1000, embedded_font());
  const double middle = layout.bed.y + 0.5 * layout.bed.height;
  EXPECT_EQ(gray_at(image, layout.bed.x, middle), 0);
  EXPECT_EQ(gray_at(image, layout.bed.x - 1, middle), 255);
  EXPECT_EQ(gray_at(image, layout.bed.right() - 1, middle), 0);
  EXPECT_EQ(gray_at(image, layout.bed.right(), middle), 255);
  EXPECT_EQ(gray_at(image, layout.bed.x + 0.5 * layout.bed.width, layout.bed.y - 1), 255);
}

TEST(Renderer, DrawsTheBedAloneWithoutFurniture) {
  Renderer renderer(make_osmesa_context());
  FrameView view = view_of({{0, 2, 1, 1.0f}});
  view.furniture = false;
  view.walls = view.floor_line = true;
  const Image image = renderer.draw(view, 1000);
  ASSERT_EQ(image.width, 1000);
  ASSERT_EQ(image.height, 400);
  EXPECT_EQ(gray_at(image, 0, 200), 0);
  int strays = 0;
  for (int y = 0; y < 400; ++y)
    for (int x = 0; x < 1000; ++x) strays += gray_at(image, x, y) < 255 && std::hypot(x, y - 200) > 102.0;
  EXPECT_EQ(strays, 0) << "nothing but the disc";
}

TEST(Renderer, DrawsWallsAndFloorOutsideTheBed) {
  Renderer renderer(make_osmesa_context());
  FrameView view = view_of({});
  view.walls = view.floor_line = true;
  const Image image = renderer.draw(view, 1000);
  const Layout layout = lay_out(view, 1000, embedded_font());
  const double middle = layout.bed.y + 0.5 * layout.bed.height;
  EXPECT_EQ(gray_at(image, layout.bed.x, middle), 255);
  EXPECT_EQ(gray_at(image, layout.bed.x - 1, middle), 0);
  EXPECT_EQ(gray_at(image, layout.bed.right(), middle), 0);
  EXPECT_EQ(gray_at(image, layout.bed.x + 5, layout.bed.bottom()), 0);
}

TEST(Renderer, GrayBarRunsFromWhiteToBlack) {
  Renderer renderer(make_osmesa_context());
  const FrameView view = synthetic_view(MapKind::gamma);
  const Image image = renderer.draw(view, 1000);
  const Box bar = lay_out(view, 1000, embedded_font()).bar;
  const double y = bar.y + 0.5 * bar.height;
  for (double share : {0.0, 0.25, 0.5, 0.75, 1.0})
    EXPECT_NEAR(gray_at(image, bar.x + share * (bar.width - 1.0), y), 255.0 * (1.0 - share), 3.0) << share;
}

TEST(Renderer, EveryTextLeavesInk) {
  Renderer renderer(make_osmesa_context());
  for (MapKind kind : {MapKind::gamma, MapKind::overloaded}) {
    const FrameView view = synthetic_view(kind);
    const Image image = renderer.draw(view, 1000);
    for (const PlacedText& text : lay_out(view, 1000, embedded_font()).texts) {
      int darkest = 255;
      for (double y = text.box.y; y < text.box.bottom(); y += 1.0)
        for (double x = text.box.x; x < text.box.right(); x += 1.0)
          darkest = std::min(darkest, gray_at(image, x, y));
      EXPECT_LT(darkest, 64) << text.text;
    }
  }
}

/// Draws the discs of a view inside the box of the bed, as the shader does: an outline, then the fill.
std::vector<std::uint8_t> drawn_by_cairo(const FrameView& view, const Layout& layout) {
  const int width = static_cast<int>(layout.bed.width), height = static_cast<int>(layout.bed.height);
  cairo_surface_t* surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
  cairo_t* cairo = cairo_create(surface);
  cairo_set_source_rgb(cairo, 1, 1, 1);
  cairo_paint(cairo);
  const auto fill_disc = [&](const Disc& disc, double radius, double shade) {
    const Camera& camera = layout.camera;
    cairo_set_source_rgb(cairo, 1 - shade, 1 - shade, 1 - shade);
    cairo_arc(cairo, camera.origin_x + camera.scale * static_cast<double>(disc.x) - layout.bed.x,
              camera.origin_y - camera.scale * static_cast<double>(disc.y) - layout.bed.y, radius, 0,
              2 * 3.14159265358979);
    cairo_fill(cairo);
  };
  for (const Disc& disc : view.discs) {
    const double radius = layout.camera.scale * static_cast<double>(disc.radius);
    const double shade = static_cast<double>(disc.shade);
    fill_disc(disc, radius, std::max(shade, 0.45));
    fill_disc(disc, radius - std::min(0.18 * radius, 2.0), shade);
  }
  cairo_surface_flush(surface);
  const unsigned char* data = cairo_image_surface_get_data(surface);
  std::vector<std::uint8_t> gray;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) gray.push_back(data[y * cairo_image_surface_get_stride(surface) + 4 * x]);
  cairo_destroy(cairo);
  cairo_surface_destroy(surface);
  return gray;
}

TEST(Renderer, AgreesWithCairo) {
  Renderer renderer(make_osmesa_context());
  FrameView view = synthetic_view(MapKind::gamma, 60, 12);
  std::erase_if(view.discs, [](const Disc& disc) { return disc.hatched > 0.5f; });
  for (int width : {400, 1600}) {
    const Image image = renderer.draw(view, width);
    const Layout layout = lay_out(view, width, embedded_font());
    std::vector<std::uint8_t> bed;
    for (double y = layout.bed.y; y < layout.bed.bottom(); y += 1.0)
      for (double x = layout.bed.x; x < layout.bed.right(); x += 1.0)
        bed.push_back(static_cast<std::uint8_t>(gray_at(image, x, y)));
    EXPECT_LT(mean_difference(bed, drawn_by_cairo(view, layout)), 0.01) << width << " px";
  }
}

TEST(Renderer, DrawsTheSameBitsAgain) {
  const FrameView view = synthetic_view(MapKind::overloaded);
  std::vector<std::uint8_t> first;
  for (int context = 0; context < 2; ++context) {
    Renderer renderer(make_osmesa_context());
    renderer.draw(synthetic_view(MapKind::gamma), 640);  // what was drawn before leaves no trace
    const Image image = renderer.draw(view, 800);
    if (context == 0) first = image.gray;
    EXPECT_EQ(image.gray, first);
    EXPECT_EQ(renderer.draw(view, 800).gray, first);
  }
}

TEST(Renderer, DrawsTheSameBitsWithAnyNumberOfThreads) {
  std::set<std::string> hashes;
  for (const char* threads : {"0", "1", "2", "4"}) {
    const std::string command = std::string("LP_NUM_THREADS=") + threads + " '" TALUS_PICTURE_HASH "'";
    std::FILE* pipe = popen(command.c_str(), "r");
    char line[64] = "";
    ASSERT_TRUE(std::fgets(line, sizeof line, pipe)) << command;
    ASSERT_EQ(pclose(pipe), 0) << command;
    hashes.insert(line);
  }
  EXPECT_EQ(hashes.size(), 1u);
}

/// Says only that something changed. Where the change is wanted, copy the file the message names over the
/// golden one.
TEST(Renderer, LooksAsBefore) {
  Renderer renderer(make_osmesa_context());
  for (MapKind kind : {MapKind::gamma, MapKind::overloaded}) {
    const std::string name = "map_" + std::string(map_name(kind)) + ".png";
    const Image image = renderer.draw(synthetic_view(kind, 30, 6, kind == MapKind::gamma), 400);
    write_png(TALUS_BINARY_DIR "/" + name, image);
    const Image golden = test::read_png(TALUS_SOURCE_DIR "/tests/golden/" + name);
    ASSERT_EQ(image.width, golden.width);
    ASSERT_EQ(image.height, golden.height) << "see " TALUS_BINARY_DIR "/" << name;
    // Processors without AVX round otherwise; one grain that moved is several times above this.
    EXPECT_LT(mean_difference(image.gray, golden.gray), 0.0005) << "see " TALUS_BINARY_DIR "/" << name;
  }
}

}  // namespace
}  // namespace talus
