#include "pictures/change_map.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fmt/core.h>
#include <utility>

#include "analysis/contacts/contact_network.h"
#include "base/errors.h"
#include "base/text.h"
#include "core/trigonometry.h"
#include "pictures/layers.h"

namespace talus::pictures {
namespace {

/// These differ from the orange and blue of the scale, from white, and, in gray, from each other.
constexpr render::Colour gained_colour{0, 105, 60}, lost_colour{215, 30, 150};
constexpr double gained_half_width = 0.10, lost_half_width = 0.10;  // D

/// Returns the part of a title that names both tilts, "12.00° minus 5.00°".
std::string between(const analysis::GrainSource& bed, const Frame& before) {
  return fmt::format("{}° minus {}°", degrees_text(bed.frame.tilt, 2), degrees_text(before.tilt, 2));
}

std::string lowercase_first(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
  return text;
}

MapLayer difference_layer(const analysis::GrainSource& bed, const Frame& before, MapSettings settings,
                          const MapExtent& extent) {
  settings.range_low.reset();
  settings.range_high.reset();
  settings.colours.reset();
  const MapLayer after = make_layer(bed, settings, extent, 0);
  const analysis::GrainSource reference{{before, bed.statics}};
  const MapLayer earlier = make_layer(reference, settings, extent, 0);
  const Scale& scale = after.scale.value();
  std::vector<double> changes(after.values.size());
  for (std::size_t i = 0; i < changes.size(); ++i)
    changes[i] = scale.logarithmic ? std::log10(after.values[i] / earlier.values[i])
                                   : after.values[i] - earlier.values[i];
  for (double& change : changes)
    if (!std::isfinite(change)) change = not_known;
  const double half = 0.5 * (scale.logarithmic ? std::log10(scale.high / scale.low) : scale.high - scale.low);
  const Scale about_zero{render::ColourMap::diverging, -half, half};
  const std::string& unit = after.legend.bars.at(0).title;
  return scaled_layer(fmt::format("Change of {}, {}", lowercase_first(after.title), between(bed, before)),
                      about_zero, std::move(changes),
                      bar_of(about_zero, scale.logarithmic ? "change (powers of ten)" : "change of " + unit),
                      true);
}

/// Returns the vector, m, from grain a to body b of contact c of `at`, with their current positions; for a
/// plane, the vector along the normal.
Vec2 towards(const analysis::GrainSource& bed, const Frame& at, Index c) {
  const FrameContacts& contacts = at.contacts;
  const Index a = contacts.a[c], b = contacts.b[c];
  if (b >= at.grain_count())
    return {bed.statics.radius[a] * contacts.nx[c], bed.statics.radius[a] * contacts.ny[c]};
  // The images that touched then, even if a periodic edge has come between them since.
  const Index image = contacts.shift[c] + at.image[a] - at.image[b];
  const Index shift = image - bed.frame.image[a] + bed.frame.image[b];
  const double period = bed.statics.periodic ? shift * bed.statics.length : 0.0;
  return {bed.frame.x[b] + period - bed.frame.x[a], bed.frame.y[b] - bed.frame.y[a]};
}

void add_gained(std::vector<render::Line>& lines, const analysis::GrainSource& bed, Index c) {
  const Index a = bed.frame.contacts.a[c];
  const double x = bed.frame.x[a], y = bed.frame.y[a];
  const Vec2 way = towards(bed, bed.frame, c);
  lines.push_back(
      line_between(x, y, x + way.x, y + way.y, gained_half_width * bed.statics.mean_diameter, gained_colour));
}

/// Adds lines from the centre of each grain to its edge, so that the space between them stays empty.
void add_lost(std::vector<render::Line>& lines, const analysis::GrainSource& bed, const Frame& before,
              Index c) {
  const Index a = before.contacts.a[c], b = before.contacts.b[c];
  const Vec2 way = towards(bed, before, c);
  const double distance = std::hypot(way.x, way.y);
  if (!(distance > 0.0)) return;
  const Vec2 along{way.x / distance, way.y / distance};
  const double half_width = lost_half_width * bed.statics.mean_diameter;
  const auto stub = [&](double x, double y, double length) {
    lines.push_back(line_between(x, y, x + length * along.x, y + length * along.y, half_width, lost_colour));
  };
  stub(bed.frame.x[a], bed.frame.y[a], bed.statics.radius[a]);
  if (b < before.grain_count()) stub(bed.frame.x[b], bed.frame.y[b], -bed.statics.radius[b]);
}

MapLayer contacts_layer(const analysis::GrainSource& bed, const Frame& before) {
  const analysis::ContactChanges changes = analysis::contact_changes(before, bed.frame);
  MapLayer layer;
  layer.title = "Contacts gained and lost";
  for (const Index c : changes.lost) add_lost(layer.lines, bed, before, c);
  for (const Index c : changes.gained) add_gained(layer.lines, bed, c);
  layer.legend.swatches = {
      line_swatch(gained_colour, 0.25, fmt::format("contacts gained: {}", changes.gained.size())),
      line_swatch(lost_colour, 0.25, fmt::format("lost: {}", changes.lost.size()))};
  return layer;
}

}  // namespace

MapKind changing_kind(const MapLayers& layers) {
  for (const MapKind kind : layers)
    if (is_scaled(kind) && kind != MapKind::size && kind != MapKind::dyed) return kind;
  return any_layer(layers, shows_gamma) ? MapKind::gamma : MapKind::displacement;
}

std::vector<MapLayer> change_layers(const analysis::GrainSource& frame, const MapSettings& settings,
                                    const MapExtent& extent) {
  const Frame& before = frame.earlier != nullptr ? *frame.earlier : frame.frame;
  const MapKind kind = changing_kind(settings.layers);
  MapSettings of_kind = settings;
  of_kind.layers = {kind};
  std::vector<MapLayer> layers;
  if (needs_reference(kind)) {
    analysis::GrainSource moved = frame;
    moved.earlier = &before;
    moved.per_degree = false;
    layers.push_back(value_layer(kind, moved, settings, {}));
  } else {
    layers.push_back(difference_layer(frame, before, of_kind, extent));
  }
  layers.push_back(contacts_layer(frame, before));
  return layers;
}

render::FrameView make_change_map(const analysis::GrainSource& frame, const MapSettings& settings,
                                  const MapExtent& extent) {
  if (settings.own) throw Error(ExitCode::usage, "the map {} shows no change", name_of(settings));
  render::FrameView view = compose_map(frame, settings, extent, change_layers(frame, settings, extent));
  view.coloured = true;
  return view;
}

}  // namespace talus::pictures
