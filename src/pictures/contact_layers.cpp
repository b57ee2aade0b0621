#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <numeric>

#include "analysis/contacts/contact_network.h"
#include "analysis/topology/topology.h"
#include "pictures/layers.h"
#include "pictures/scale.h"
#include "stress/stress.h"

namespace talus::pictures {

render::Line centre_line(const BedFrame& bed, Index contact, double half_width,
                         const render::Colour& colour) {
  const Frame& frame = bed.frame;
  const FrameContacts& contacts = frame.contacts;
  const Index a = contacts.a[contact], b = contacts.b[contact];
  const bool grain = b < frame.grain_count();
  const double x1 = grain ? frame.x[b] + contacts.shift[contact] * bed.statics.length : contacts.px[contact];
  const double y1 = grain ? frame.y[b] : contacts.py[contact];
  return line_between(frame.x[a], frame.y[a], x1, y1, half_width, colour);
}

MapLayer forces_layer(const analysis::GrainSource& bed, const OverColour& over) {
  const render::Colour strong_colour = over.value_or(render::black);
  render::Colour weak_colour = over.value_or(render::gray(0.4));
  if (over) weak_colour.alpha = 110;  // keeps the grains below visible
  const FrameContacts& contacts = bed.frame.contacts;
  const double mean = std::accumulate(contacts.fn.begin(), contacts.fn.end(), 0.0) / contacts.count();
  MapLayer layer;
  layer.title = "Force chains, width by f_n";
  if (!over)  // outlines that are lighter than the lines
    layer.styles.assign(static_cast<std::size_t>(bed.statics.free_count),
                        {render::white, render::gray(0.12)});
  layer.lines.reserve(contacts.fn.size());
  // The strong network is drawn above the weak one.
  for (const bool strong : {false, true})
    for (Index c = 0; c < contacts.count(); ++c) {
      const double force = contacts.fn[c] / mean;
      if ((force > 1.0) != strong) continue;
      layer.lines.push_back(centre_line(
          bed, c, force_lines.half_width * std::min(force, force_lines.widest) * bed.statics.mean_diameter,
          strong ? strong_colour : weak_colour));
    }
  layer.legend.swatches = {line_swatch(strong_colour, 0.35, "strong: f_n > ⟨f_n⟩"),
                           line_swatch(weak_colour, 0.12, "weak: f_n ≤ ⟨f_n⟩")};
  return layer;
}

MapLayer critical_layer(const analysis::GrainSource& bed, const OverColour& over) {
  const render::Colour colour = over.value_or(render::Colour{200, 40, 0});
  const FrameContacts& contacts = bed.frame.contacts;
  MapLayer layer;
  const double length = critical_lines.length * bed.statics.mean_diameter;
  for (Index c = 0; c < contacts.count(); ++c) {
    if (contacts.status[c] != ContactStatus::sliding) continue;
    // Through the contact point, in the direction of sliding.
    const double x = 0.5 * length * -contacts.ny[c], y = 0.5 * length * contacts.nx[c];
    layer.lines.push_back(line_between(contacts.px[c] - x, contacts.py[c] - y, contacts.px[c] + x,
                                       contacts.py[c] + y,
                                       critical_lines.half_width * bed.statics.mean_diameter, colour));
  }
  layer.title = "Critical contacts";
  if (contacts.count() > 0)
    layer.title +=
        fmt::format(", {:.1f} % of all", 100.0 * static_cast<double>(layer.lines.size()) / contacts.count());
  layer.legend.swatches = {line_swatch(colour, 0.35, "friction fully mobilised")};
  return layer;
}

MapLayer coordination_layer(const analysis::GrainSource& bed, const ScaleChoice& choice) {
  constexpr double most = 6.0;  // maximum for equal disks
  const FrameContacts& contacts = bed.frame.contacts;
  const std::vector<Index> counts =
      stress::contacts_of_grains(contacts.a, contacts.b, bed.statics.free_count);
  const Scale scale = chosen({render::ColourMap::viridis, 0.0, most}, choice);
  return scaled_layer(fmt::format("Contacts of grains, z = {:.2f}", stress::coordination_number(counts)),
                      scale, {counts.begin(), counts.end()}, bar_of(scale, "contacts that carry force"));
}

MapLayer rigid_layer(const analysis::GrainSource& bed, bool over_grains) {
  constexpr render::Colour largest_colour{0, 114, 178}, other_colour{230, 159, 0};
  const Index fixed = bed.statics.free_count;
  if (bed.frame.friction.grains == 0.0) {
    MapLayer none;
    none.styles.assign(static_cast<std::size_t>(fixed), outline_style());
    none.title = "Rigid clusters are not counted without friction";
    return none;
  }
  const std::vector<Index> label = analysis::find_rigid_clusters(fixed + 1, analysis::bonds_of(bed)).label;
  std::vector<Index> bodies(label.size(), 0), grains(label.size(), 0);
  for (Index body = 0; body <= fixed; ++body) {
    ++bodies[label[body]];
    grains[label[body]] += body < fixed ? 1 : 0;
  }
  const Index largest = static_cast<Index>(std::ranges::max_element(grains) - grains.begin());
  const auto style_in = [](const render::Colour& fill) { return GrainStyle{fill, rim_of(fill)}; };
  MapLayer layer;
  for (Index i = 0; i < fixed; ++i)
    layer.styles.push_back(bodies[label[i]] < 2
                               ? outline_style()
                               : style_in(label[i] == largest ? largest_colour : other_colour));
  const bool any = bodies[largest] > 1;
  const double share = any ? 100.0 * grains[largest] / std::max<Index>(1, fixed) : 0.0;
  layer.title = any ? fmt::format("Rigid clusters, largest {:.0f} %{}", share,
                                  label[fixed] == largest ? " with the floor" : "")
                    : std::string("Rigid clusters, none");
  layer.legend.swatches = {disc_swatch(style_in(largest_colour), "largest"),
                           disc_swatch(style_in(other_colour), "others")};
  if (!over_grains) layer.legend.swatches.push_back(disc_swatch(outline_style(), "in none"));
  return layer;
}

}  // namespace talus::pictures
