#include "view/selection_scene.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/free_grains.h"
#include "pictures/bed_view.h"
#include "view/rings.h"

namespace talus {
namespace {

constexpr std::size_t few = 500;                   // grains whose rings are drawn finely
constexpr double largest_ring_width = 0.05;        // D
constexpr double least_ring_width = 1.0 / 2500.0;  // of the width of the picture: about a pixel

bool is_in_picture(const FrameView& view, const BedFrame& bed, std::size_t i) {
  const double margin = bed.statics.radius[i];
  const double x = bed.frame.x[i], y = bed.frame.y[i], period = period_of(bed.statics);
  if (y < view.y_min - margin || y > view.y_max + margin) return false;
  return std::ranges::any_of(std::initializer_list<double>{x - period, x, x + period}, [&](double at) {
    return at >= view.x_min - margin && at <= view.x_max + margin;
  });
}

void add_contact(FrameView& view, const BedFrame& bed, std::size_t c, double half_width) {
  const FrameContacts& contacts = bed.frame.contacts;
  const RunStatics& statics = bed.statics;
  const auto a = static_cast<std::size_t>(contacts.a[c]);
  const Vec2 from{bed.frame.x[a], bed.frame.y[a]};
  const bool plane = contacts.b[c] >= bed.frame.grain_count();
  const double reach =
      statics.radius[a] + (plane ? 0.0 : statics.radius[static_cast<std::size_t>(contacts.b[c])]);
  for (const auto& [width, colour] : {std::pair{2.0 * half_width, white}, {half_width, selection_colour}}) {
    add_line(view,
             {static_cast<float>(from.x), static_cast<float>(from.y),
              static_cast<float>(from.x + reach * contacts.nx[c]),
              static_cast<float>(from.y + reach * contacts.ny[c]), static_cast<float>(width), colour},
             statics);
    add_circle(view, {contacts.px[c], contacts.py[c]}, 0.22 * statics.mean_diameter, width, colour, statics);
  }
}

/// Line by line, each from where the bed is: its images follow from that.
void add_trail(FrameView& view, const BedFrame& bed, const std::vector<Vec2>& trail, double half_width,
               const Colour& colour) {
  const double period = period_of(bed.statics);
  for (std::size_t k = 1; k < trail.size(); ++k) {
    const Vec2 from = trail[k - 1], to = trail[k];
    const double shift = period > 0.0 ? period * std::floor(from.x / period) : 0.0;
    add_line(
        view,
        {static_cast<float>(from.x - shift), static_cast<float>(from.y), static_cast<float>(to.x - shift),
         static_cast<float>(to.y), static_cast<float>(half_width), colour},
        bed.statics);
  }
}

}  // namespace

void add_selection(FrameView& view, const BedFrame& bed, const SelectionMarks& marks) {
  const double d = bed.statics.mean_diameter, width = view.x_max - view.x_min;
  const double half_width = std::clamp(least_ring_width * width, 0.02 * d, largest_ring_width * d);
  const int lines = marks.grains.size() > few ? 12 : 32;
  for (const auto& [pen, colour] : {std::pair{2.0 * half_width, white}, {half_width, trail_colour}})
    for (const std::vector<Vec2>& trail : marks.trails) add_trail(view, bed, trail, pen, colour);
  for (const Index grain : marks.grains) {
    const auto i = static_cast<std::size_t>(grain);
    if (!is_in_picture(view, bed, i)) continue;
    add_circle(view, {bed.frame.x[i], bed.frame.y[i]}, bed.statics.radius[i] - half_width, half_width,
               selection_colour, bed.statics, lines);
  }
  if (marks.contact) add_contact(view, bed, static_cast<std::size_t>(*marks.contact), half_width);
}

}  // namespace talus
