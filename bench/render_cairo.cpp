/// Draws the pictures of render_bench and writes them as PNG by cairo, and their discs as CSV for other
/// peers: render_cairo 8000|100000 gray|colour PICTURE.png DISCS.csv. Prints the median milliseconds of
/// drawing and of the whole frame.

#include <cairo/cairo.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "pictures.h"
#include "program.h"

namespace talus::bench {
namespace {

void set_colour(cairo_t* cairo, const render::Colour& colour) {
  cairo_set_source_rgb(cairo, colour.red / 255.0, colour.green / 255.0, colour.blue / 255.0);
}

void fill_disc(cairo_t* cairo, double x, double y, double radius, const render::Colour& colour) {
  set_colour(cairo, colour);
  cairo_arc(cairo, x, y, radius, 0.0, 2.0 * std::numbers::pi);
  cairo_fill(cairo);
}

/// Draws the rim, then the fill within it, with the width of the shader.
void draw(cairo_t* cairo, const render::FrameView& view, int width) {
  const double scale = width / view.x_max;
  set_colour(cairo, render::white);
  cairo_paint(cairo);
  for (const render::Disc& disc : view.discs) {
    const double x = scale * static_cast<double>(disc.x),
                 y = scale * (view.y_max - static_cast<double>(disc.y)),
                 radius = scale * static_cast<double>(disc.radius);
    fill_disc(cairo, x, y, radius, disc.rim);
    fill_disc(cairo, x, y, radius - std::min(0.18 * radius, 2.0), disc.fill);
  }
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

int run(int argc, char** argv) {
  if (argc != 5) throw Error(ExitCode::usage, "expected: 8000|100000 gray|colour PICTURE.png DISCS.csv");
  const PictureSize size = std::string(argv[1]) == "8000" ? paper_picture : large_picture;
  const render::FrameView view = picture(size, std::string(argv[2]) == "colour");
  write_discs(argv[4], view, size.width);
  cairo_surface_t* surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, size.width, size.width / 4);
  cairo_t* cairo = cairo_create(surface);
  std::vector<double> drawing, frames;
  using Clock = std::chrono::steady_clock;
  const auto since = [](Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  };
  for (int repeat = 0; repeat < 9; ++repeat) {
    const Clock::time_point start = Clock::now();
    draw(cairo, view, size.width);
    cairo_surface_flush(surface);
    drawing.push_back(since(start));
    if (cairo_surface_write_to_png(surface, argv[3]) != CAIRO_STATUS_SUCCESS)
      throw Error(ExitCode::cannot_create, std::string(argv[3]) + ": cannot be written");
    frames.push_back(since(start));
  }
  cairo_destroy(cairo);
  cairo_surface_destroy(surface);
  std::printf("%.2f %.2f\n", median(drawing), median(frames));
  return 0;
}

}  // namespace
}  // namespace talus::bench

int main(int argc, char** argv) {
  return talus::bench::run_program("render_cairo", talus::bench::run, argc, argv);
}
