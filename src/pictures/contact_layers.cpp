#include <algorithm>
#include <fmt/core.h>
#include <numeric>

#include "pictures/layers.h"
#include "pictures/texts.h"

namespace talus::pictures {
namespace {

/// Returns a line from centre to centre, or to the contact point at a wall.
render::Line centre_line(const BedFrame& bed, Index contact) {
  const Frame& frame = bed.frame;
  const FrameContacts& contacts = frame.contacts;
  const Index a = contacts.a[contact], b = contacts.b[contact];
  const bool grain = b < frame.grain_count();
  const double x1 = grain ? frame.x[b] + contacts.shift[contact] * bed.statics.length : contacts.px[contact];
  const double y1 = grain ? frame.y[b] : contacts.py[contact];
  render::Line line;
  line.x0 = static_cast<float>(frame.x[a]);
  line.y0 = static_cast<float>(frame.y[a]);
  line.x1 = static_cast<float>(x1);
  line.y1 = static_cast<float>(y1);
  return line;
}

/// Returns a line through the contact point in the direction of sliding.
render::Line sliding_line(const FrameContacts& contacts, Index contact, double length) {
  const double x = 0.5 * length * -contacts.ny[contact];
  const double y = 0.5 * length * contacts.nx[contact];
  render::Line line;
  line.x0 = static_cast<float>(contacts.px[contact] - x);
  line.y0 = static_cast<float>(contacts.py[contact] - y);
  line.x1 = static_cast<float>(contacts.px[contact] + x);
  line.y1 = static_cast<float>(contacts.py[contact] + y);
  return line;
}

render::Swatch line_swatch(const render::Colour& colour, double width, const std::string& label) {
  return {render::Swatch::Kind::line, colour, colour, width, label};
}

}  // namespace

MapLayer forces_layer(const MapFrame& bed, const OverColour& over) {
  const render::Colour strong_colour = over.value_or(render::black);
  render::Colour weak_colour = over.value_or(render::gray(0.4));
  if (over) weak_colour.alpha = 110;  // keeps the grains below visible
  const FrameContacts& contacts = bed.frame.contacts;
  const double mean = std::accumulate(contacts.fn.begin(), contacts.fn.end(), 0.0) / contacts.count();
  MapLayer layer;
  layer.title = "Force chains, width by f_n";
  layer.lines.reserve(contacts.fn.size());
  // The strong network is drawn above the weak one.
  for (const bool strong : {false, true})
    for (Index c = 0; c < contacts.count(); ++c) {
      const double force = contacts.fn[c] / mean;
      if ((force > 1.0) != strong) continue;
      render::Line line = centre_line(bed, c);
      line.half_width = static_cast<float>(force_lines.half_width * std::min(force, force_lines.widest) *
                                           bed.statics.mean_diameter);
      line.colour = strong ? strong_colour : weak_colour;
      layer.lines.push_back(line);
    }
  layer.legend.swatches = {line_swatch(strong_colour, 0.35, "strong: f_n > ⟨f_n⟩"),
                           line_swatch(weak_colour, 0.12, "weak: f_n ≤ ⟨f_n⟩")};
  return layer;
}

MapLayer critical_layer(const MapFrame& bed, const OverColour& over) {
  const render::Colour colour = over.value_or(render::Colour{200, 40, 0});
  const FrameContacts& contacts = bed.frame.contacts;
  MapLayer layer;
  for (Index c = 0; c < contacts.count(); ++c) {
    if (contacts.status[c] != ContactStatus::sliding) continue;
    render::Line line = sliding_line(contacts, c, critical_lines.length * bed.statics.mean_diameter);
    line.half_width = static_cast<float>(critical_lines.half_width * bed.statics.mean_diameter);
    line.colour = colour;
    layer.lines.push_back(line);
  }
  layer.title = "Critical contacts";
  if (contacts.count() > 0)
    layer.title +=
        fmt::format(", {:.1f} % of all", 100.0 * static_cast<double>(layer.lines.size()) / contacts.count());
  layer.legend.swatches = {line_swatch(colour, 0.35, "friction fully mobilised")};
  return layer;
}

}  // namespace talus::pictures
