#include "pictures/bed_view.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <string>

#include "pictures/scale.h"

namespace talus::pictures {
namespace {

bool is_seen(const render::FrameView& view, double left, double right, double bottom, double top) {
  return right > view.x_min && left < view.x_max && top > view.y_min && bottom < view.y_max;
}

}  // namespace

bool is_seen(const render::FrameView& view, const render::Disc& disc) {
  return is_seen(view, disc.x - disc.radius, disc.x + disc.radius, disc.y - disc.radius,
                 disc.y + disc.radius);
}

bool is_seen(const render::FrameView& view, const render::Line& line) {
  const auto [left, right] = std::minmax(line.x0, line.x1);
  const auto [bottom, top] = std::minmax(line.y0, line.y1);
  const float half = line.half_width;
  return is_seen(view, left - half, right + half, bottom - half, top + half);
}

render::FrameView empty_view(const MapExtent& extent) {
  render::FrameView view;
  view.furniture = false;
  view.x_min = extent.x_min;
  view.x_max = extent.x_max;
  view.y_min = extent.y_min;
  view.y_max = extent.y_max;
  return view;
}

void add_disc(render::FrameView& view, const render::Disc& disc, const RunStatics& statics) {
  if (is_seen(view, disc)) view.discs.push_back(disc);
  if (!statics.periodic) return;
  for (const double shift : {statics.length, -statics.length}) {
    render::Disc image = disc;
    image.x += static_cast<float>(shift);
    if (is_seen(view, image)) view.discs.push_back(image);
  }
}

void add_line(render::FrameView& view, const render::Line& line, const RunStatics& statics) {
  if (is_seen(view, line)) view.lines.push_back(line);
  if (!statics.periodic) return;
  for (const double shift : {statics.length, -statics.length}) {
    render::Line image = line;
    image.x0 += static_cast<float>(shift);
    image.x1 += static_cast<float>(shift);
    if (is_seen(view, image)) view.lines.push_back(image);
  }
}

render::Disc disc_of(const BedFrame& bed, Index grain) {
  render::Disc disc;
  disc.x = static_cast<float>(bed.frame.x[grain]);
  disc.y = static_cast<float>(bed.frame.y[grain]);
  disc.radius = static_cast<float>(bed.statics.radius[grain]);
  if (grain >= bed.statics.free_count) {
    disc.rim = render::gray(0.75);
    disc.hatched = 1.0f;
  }
  return disc;
}

double scale_diameters(double width, double diameter) {
  constexpr double longest = 0.3, shortest = 0.02;  // fractions of the width
  const double share = 10.0 * diameter / width;
  if (share <= longest && share >= shortest) return 10.0;
  const double wanted = (share > longest ? longest : 2.0 * shortest) * width / diameter;
  const double decade = std::pow(10.0, std::floor(std::log10(wanted)));
  for (const double factor : {5.0, 2.0})
    if (factor * decade <= wanted) return factor * decade;
  return decade;
}

void add_surroundings(render::FrameView& view, const BedFrame& bed) {
  const RunStatics& statics = bed.statics;
  view.left_wall = !statics.periodic && view.x_min <= 0.0;
  view.right_wall = !statics.periodic && view.x_max >= statics.length;
  view.floor_line = statics.free_count == bed.frame.grain_count() && view.y_min <= 0.0;
  const double diameters = scale_diameters(view.x_max - view.x_min, statics.mean_diameter);
  view.scale_length = diameters * statics.mean_diameter;
  view.scale_label = number_label(diameters) + " D";
}

}  // namespace talus::pictures
