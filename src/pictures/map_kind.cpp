#include "pictures/map_kind.h"

#include <algorithm>
#include <array>
#include <fmt/core.h>

#include "analysis/frame_quantities.h"
#include "base/errors.h"
#include "base/text.h"

namespace talus::pictures {
namespace {

/// Properties of a map, which may have several.
enum Trait : unsigned {
  none = 0,
  theta_c = 1,  ///< its scale or its threshold is Gamma_c
  gamma = 2,    ///< shows the gamma of grains, or a result derived from it
  coarse = 4,   ///< an average over a chosen width
  earlier = 8,  ///< measured from an earlier frame
  fitted = 16   ///< its range fits the frames that are drawn
};

struct MapEntry {
  MapKind kind;
  std::string_view name, help = {}, symbol = {}, unit = {};
  unsigned traits = none;
  const analysis::FrameQuantity* quantity = nullptr;
};

/// Maps in the order in which they are listed. Those with only a name show a quantity of grains.
constexpr auto listed = std::to_array<MapEntry>({
    {MapKind::gamma, "gamma", "stress ratio of each grain and its neighbours, or of the grain alone", "γ", "",
     theta_c | gamma},
    {MapKind::overloaded, "overloaded", "overloaded grains, gamma >= Gamma_c", "", "", theta_c | gamma},
    {MapKind::clusters, "clusters", "clusters of overloaded grains, each in its own colour", "", "",
     theta_c | gamma},
    {MapKind::coarse, "coarse", "stress ratio of the neighbourhood of each grain", "γ_l", "",
     theta_c | coarse},
    {MapKind::pressure, "pressure"},
    {MapKind::displacement, "displacement"},
    {MapKind::rotation, "rotation"},
    {MapKind::forces, "forces", "force chains: lines between centres, as wide as the normal force is large"},
    {MapKind::critical, "critical", "contacts with fully mobilised friction"},
    {MapKind::speed, "speed"},
    {MapKind::nonaffine, "nonaffine"},
    {MapKind::shear, "shear"},
    {MapKind::dilation, "dilation"},
    {MapKind::vorticity, "vorticity"},
    {MapKind::coordination, "coordination", "contacts of each grain that carry force", "contacts"},
    {MapKind::mobilised, "mobilised"},
    {MapKind::rigid, "rigid", "grains that can only move as one: the largest rigid cluster, and others"},
    {MapKind::size, "size", "diameter of each grain", "diameter", "D"},
    {MapKind::cells, "cells"},
    {MapKind::density, "density"},
    {MapKind::stress, "stress"},
    {MapKind::shear_rate, "shear_rate"},
    {MapKind::temperature, "temperature"},
    {MapKind::dyed, "dyed", "layers and columns as they were when the tilt began", "height as the tilt began",
     "D"},
});

unsigned traits_of(const analysis::FrameQuantity& quantity) {
  const analysis::ScaleRule scale = quantity.map.scale;
  return (quantity.need == analysis::FrameNeed::length ? coarse : none) |
         (quantity.need == analysis::FrameNeed::earlier_frame ? earlier : none) |
         (scale == analysis::ScaleRule::sizes || scale == analysis::ScaleRule::about_zero ? fitted : none);
}

/// Returns the listed maps, followed by the maps of other quantities of grains.
const std::vector<MapEntry>& entries() {
  static const std::vector<MapEntry> all = [] {
    std::vector<MapEntry> found(listed.begin(), listed.end());
    for (const analysis::FrameQuantity& quantity : analysis::grain_quantities()) {
      const analysis::MapRule& rule = quantity.map;
      if (rule.scale == analysis::ScaleRule::none) continue;
      auto entry = std::ranges::find(found, rule.name, &MapEntry::name);
      if (entry == found.end()) entry = found.insert(entry, {static_cast<MapKind>(found.size()), rule.name});
      entry->help = rule.help;
      entry->symbol = rule.symbol;
      entry->traits = traits_of(quantity);
      entry->quantity = &quantity;
    }
    return found;
  }();
  return all;
}

const MapEntry& entry_of(MapKind kind) { return entries()[static_cast<std::size_t>(kind)]; }

bool has(MapKind kind, Trait trait) { return (entry_of(kind).traits & trait) != 0; }

MapKind layer_of(std::string_view name, std::string_view whole, std::span<const OwnQuantity> own) {
  const auto found = std::ranges::find(entries(), name, &MapEntry::name);
  if (found != entries().end()) return found->kind;
  std::vector<std::string> names = names_of(entries());
  for (const OwnQuantity& quantity : own) names.push_back(quantity.name);
  throw Error(ExitCode::usage,
              "map '{}': expected one of {}, or two of them joined by +, such as gamma+forces{}",
              visible_word(whole), joined(names, ", "), did_you_mean(name, names));
}

}  // namespace

std::span<const MapKind> map_kinds() {
  static const std::vector<MapKind> kinds = [] {
    std::vector<MapKind> all;
    for (const MapEntry& entry : entries()) all.push_back(entry.kind);
    return all;
  }();
  return kinds;
}

std::string_view map_name(MapKind kind) { return entry_of(kind).name; }

std::string_view map_help(MapKind kind) { return entry_of(kind).help; }

std::pair<std::string, std::string> map_reading(MapKind kind, const RunStatics& statics) {
  const MapEntry& entry = entry_of(kind);
  if (entry.quantity == nullptr) return {std::string(entry.symbol), std::string(entry.unit)};
  return {std::string(entry.symbol), analysis::bed_unit(entry.quantity->unit, statics).text};
}

const analysis::FrameQuantity* shown_quantity(MapKind kind) { return entry_of(kind).quantity; }

bool is_scaled(MapKind kind) { return !entry_of(kind).symbol.empty(); }
bool is_signed(MapKind kind) {
  const analysis::FrameQuantity* quantity = entry_of(kind).quantity;
  return quantity != nullptr && quantity->map.scale == analysis::ScaleRule::about_zero;
}

std::string list_of_maps() { return joined(entries(), ", ", &MapEntry::name); }

bool needs_theta_c(MapKind kind) { return has(kind, theta_c); }
bool shows_gamma(MapKind kind) { return has(kind, gamma); }
bool is_coarse(MapKind kind) { return has(kind, coarse); }
bool needs_reference(MapKind kind) { return has(kind, earlier); }
bool fits_frames(MapKind kind) { return has(kind, fitted); }

bool shows(const MapLayers& layers, MapKind kind) { return std::ranges::count(layers, kind) > 0; }

bool any_layer(const MapLayers& layers, bool (*has)(MapKind)) { return std::ranges::any_of(layers, has); }

MapLayers map_layers(std::string_view name, std::span<const OwnQuantity> own) {
  MapLayers layers;
  for (std::string_view rest = name;;) {
    const auto plus = rest.find('+');
    layers.push_back(layer_of(rest.substr(0, plus), name, own));
    if (plus == std::string_view::npos) break;
    rest.remove_prefix(plus + 1);
  }
  if (layers.size() > 2) throw Error(ExitCode::usage, "map '{}': at most two can be overlaid", name);
  if (layers.size() == 2 && layers[0] == layers[1])
    throw Error(ExitCode::usage, "map '{}': the same map twice", name);
  return layers;
}

std::string layers_name(const MapLayers& layers) { return joined(layers, "+", map_name); }

}  // namespace talus::pictures
