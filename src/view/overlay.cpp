/// Marks drawn over the map of a frame. They are thin and unfilled, so that the map stays readable.

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "analysis/free_grains.h"
#include "analysis/overload/clusters.h"
#include "core/trigonometry.h"
#include "pictures/bed_view.h"
#include "pictures/layers.h"
#include "pictures/scale.h"
#include "view/scene.h"

namespace talus::view {
namespace {

constexpr render::Colour length_colour{220, 50, 0}, circle_colour{70, 110, 170}, cluster_colour{240, 130, 0};
constexpr std::size_t few = 500;                 // maximum number of grains whose rings are drawn finely
constexpr double largest_ring_width = 0.05;      // D
constexpr double min_ring_width = 1.0 / 2500.0;  // relative to the width of the picture: about a pixel

void add_stroke(render::FrameView& view, Vec2 from, Vec2 to, double half_width, const render::Colour& colour,
                const RunStatics& statics) {
  pictures::add_line(view, pictures::line_between(from.x, from.y, to.x, to.y, half_width, colour), statics);
}

/// Adds a circle made of straight lines, with its images in a periodic bed.
void add_circle(render::FrameView& view, Vec2 centre, double radius, double half_width,
                const render::Colour& colour, const RunStatics& statics, int circle_lines = 64) {
  const auto corner = [&](int k) {
    const double angle = 2.0 * pi * k / circle_lines;
    return Vec2{centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)};
  };
  for (int k = 0; k < circle_lines; ++k)
    add_stroke(view, corner(k), corner(k + 1), half_width, colour, statics);
}

bool is_in_picture(const render::FrameView& view, const BedFrame& bed, std::size_t i) {
  const double margin = bed.statics.radius[i];
  const double x = bed.frame.x[i], y = bed.frame.y[i], period = analysis::period_of(bed.statics);
  if (y < view.y_min - margin || y > view.y_max + margin) return false;
  return std::ranges::any_of(std::initializer_list<double>{x - period, x, x + period}, [&](double at) {
    return at >= view.x_min - margin && at <= view.x_max + margin;
  });
}

void add_contact(render::FrameView& view, const BedFrame& bed, std::size_t c, double half_width) {
  const FrameContacts& contacts = bed.frame.contacts;
  const RunStatics& statics = bed.statics;
  const auto a = static_cast<std::size_t>(contacts.a[c]);
  const Vec2 from{bed.frame.x[a], bed.frame.y[a]};
  const bool plane = contacts.b[c] >= bed.frame.grain_count();
  const double reach =
      statics.radius[a] + (plane ? 0.0 : statics.radius[static_cast<std::size_t>(contacts.b[c])]);
  for (const auto& [width, colour] :
       {std::pair{2.0 * half_width, render::white}, {half_width, selection_colour}}) {
    add_stroke(view, from, {from.x + reach * contacts.nx[c], from.y + reach * contacts.ny[c]}, width, colour,
               statics);
    add_circle(view, {contacts.px[c], contacts.py[c]}, 0.22 * statics.mean_diameter, width, colour, statics);
  }
}

/// Adds a stroke between each grain of a cluster and each neighbour outside it. Fills and rims of grains
/// stay, because a cluster can make up most of the bed.
void add_outline(render::FrameView& view, const BedFrame& bed, const analysis::Clusters& clusters,
                 Index cluster) {
  if (cluster < 0) return;
  const RunStatics& statics = bed.statics;
  const double period = analysis::period_of(statics);
  for (const analysis::Link& link : analysis::neighbour_links(bed)) {
    if ((clusters.label[link.a] == cluster) == (clusters.label[link.b] == cluster)) continue;
    const double r = statics.radius[link.a], x = bed.frame.x[link.a], y = bed.frame.y[link.a];
    const double dx = bed.frame.x[link.b] + link.shift * period - x, dy = bed.frame.y[link.b] - y;
    const double distance = std::hypot(dx, dy);
    const double ux = dx / distance, uy = dy / distance;
    const double reach = r + 0.5 * (distance - r - statics.radius[link.b]);
    const double half = 0.6 * std::min(r, statics.radius[link.b]);
    add_stroke(view, {x + reach * ux - half * uy, y + reach * uy + half * ux},
               {x + reach * ux + half * uy, y + reach * uy - half * ux}, 0.07 * statics.mean_diameter,
               cluster_colour, statics);
  }
}

/// Adds a ring on a white background, visible over dark and light grains.
void add_ring(render::FrameView& view, Vec2 centre, double radius, double half_width,
              const render::Colour& colour, const RunStatics& statics) {
  add_circle(view, centre, radius, 2.0 * half_width, render::white, statics);
  add_circle(view, centre, radius, half_width, colour, statics);
}

void add_inspected(render::FrameView& view, const BedFrame& bed, const Overlay& overlay) {
  if (!overlay.selected) return;
  const RunStatics& statics = bed.statics;
  const double d = statics.mean_diameter;
  const double pen = std::min(d, (view.x_max - view.x_min) / 60.0);  // finer if only a small part is shown
  const auto grain = static_cast<std::size_t>(*overlay.selected);
  const Vec2 centre{bed.frame.x[grain], bed.frame.y[grain]};
  for (const double diameter : overlay.diameters)
    add_ring(view, centre, 0.5 * diameter, 0.05 * pen, circle_colour, statics);
  if (overlay.critical_length)
    add_ring(view, centre, 0.5 * *overlay.critical_length, 0.09 * pen, length_colour, statics);
  add_ring(view, centre, statics.radius[grain] + 0.05 * d, 0.08 * pen, selection_colour, statics);
}

void add_selection(render::FrameView& view, const BedFrame& bed, const Overlay& overlay) {
  const double d = bed.statics.mean_diameter, width = view.x_max - view.x_min;
  const double half_width = std::clamp(min_ring_width * width, 0.02 * d, largest_ring_width * d);
  const int lines = overlay.grains.size() > few ? 12 : 32;
  for (const Index grain : overlay.grains) {
    const auto i = static_cast<std::size_t>(grain);
    if (!is_in_picture(view, bed, i)) continue;
    add_circle(view, {bed.frame.x[i], bed.frame.y[i]}, bed.statics.radius[i] - half_width, half_width,
               selection_colour, bed.statics, lines);
  }
  if (overlay.contact) add_contact(view, bed, static_cast<std::size_t>(*overlay.contact), half_width);
}

}  // namespace

std::vector<double> growing_diameters(double largest) {
  if (!(largest > 0.0)) return {};
  const double step = pictures::round_step(largest, 5);
  std::vector<double> diameters;
  for (int k = 1; k * step < largest - 0.25 * step; ++k) diameters.push_back(k * step);
  diameters.push_back(largest);
  return diameters;
}

void add_overlay(render::FrameView& view, const BedFrame& bed, const Overlay& overlay,
                 const analysis::Clusters& clusters, const pictures::MapExtent& extent) {
  const auto first = static_cast<std::ptrdiff_t>(view.lines.size());
  add_outline(view, bed, clusters, overlay.cluster);
  add_inspected(view, bed, overlay);
  add_selection(view, bed, overlay);
  // Rings, and their images in a periodic bed, would float in the margins of the picture.
  const auto is_outside = [&extent](const render::Line& line) {
    const double x = 0.5 * (line.x0 + line.x1), y = 0.5 * (line.y0 + line.y1);
    return x < extent.x_min || x > extent.x_max || y < extent.y_min || y > extent.y_max;
  };
  view.lines.erase(std::remove_if(view.lines.begin() + first, view.lines.end(), is_outside),
                   view.lines.end());
}

}  // namespace talus::view
