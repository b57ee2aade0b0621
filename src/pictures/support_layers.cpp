#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "analysis/contacts/contact_network.h"
#include "analysis/topology/rigid_clusters.h"
#include "pictures/layers.h"
#include "stress/bed.h"

namespace talus::pictures {
namespace {

constexpr render::Colour largest_colour{0, 114, 178}, other_colour{230, 159, 0};

render::Swatch grain_swatch(const GrainStyle& style, const std::string& label) {
  return {render::Swatch::Kind::disc, style.fill, style.rim, 0.0, label};
}

}  // namespace

MapLayer coordination_layer(const MapFrame& bed, const ScaleChoice& choice) {
  constexpr double most = 6.0;  // maximum for equal disks
  const FrameContacts& contacts = bed.frame.contacts;
  const std::vector<Index> counts =
      stress::contacts_of_grains(contacts.a, contacts.b, bed.statics.free_count);
  const Scale scale = chosen({render::ColourMap::viridis, 0.0, most}, choice);
  return scaled_layer(fmt::format("Contacts of grains, z = {:.2f}", stress::coordination_number(counts)),
                      scale, {counts.begin(), counts.end()}, bar_of(scale, "contacts that carry force"));
}

MapLayer rigid_layer(const MapFrame& bed, bool over_grains) {
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
  layer.title = any ? fmt::format("Rigid clusters, the largest has {:.0f} % of the grains", share)
                    : std::string("No rigid cluster");
  layer.legend.swatches = {
      grain_swatch(style_in(largest_colour),
                   any && label[fixed] == largest ? "largest, with the floor" : "largest"),
      grain_swatch(style_in(other_colour), "others")};
  if (!over_grains) layer.legend.swatches.push_back(grain_swatch(outline_style(), "in none"));
  return layer;
}

}  // namespace talus::pictures
