#include "pictures/map_kind.h"

#include <algorithm>
#include <array>
#include <fmt/core.h>

#include "core/errors.h"
#include "core/nearest_word.h"
#include "core/text.h"
#include "core/visible_text.h"

namespace talus {
namespace {

/// What a map has to do with; one may have several.
enum Trait : unsigned {
  none = 0,
  theta_c = 1,  ///< its scale or its threshold is Gamma_c
  gamma = 2,    ///< shows the gamma of grains, or what follows from it
  coarse = 4,   ///< an average of a chosen width
  earlier = 8,  ///< measured from an earlier frame
  fitted = 16   ///< its range fits the frames that are drawn
};

struct MapEntry {
  MapKind kind;
  std::string_view name, help, symbol, unit;
  unsigned traits;
};

constexpr auto entries = std::to_array<MapEntry>({
    {MapKind::gamma, "gamma", "stress ratio of each grain and its neighbours, or of the grain alone", "γ", "",
     theta_c | gamma},
    {MapKind::overloaded, "overloaded", "overloaded grains, gamma >= Gamma_c", "", "", theta_c | gamma},
    {MapKind::clusters, "clusters", "clusters of overloaded grains, each in a colour of its own", "", "",
     theta_c | gamma},
    {MapKind::coarse, "coarse", "stress ratio of the neighbourhood of each grain", "γ_l", "",
     theta_c | coarse},
    {MapKind::pressure, "pressure", "pressure in each grain, over rho g D", "P", "ρgD", none},
    {MapKind::displacement, "displacement", "how far each grain has moved; over another map: arrows",
     "displacement", "D", earlier | fitted},
    {MapKind::rotation, "rotation", "how far each grain has turned", "rotation", "°", earlier | fitted},
    {MapKind::forces, "forces", "force chains: lines between centres, as wide as the normal force is large",
     "", "", none},
    {MapKind::critical, "critical", "contacts with fully mobilised friction", "", "", none},
    {MapKind::speed, "speed", "speed of each grain, over sqrt(g D)", "speed", "√(gD)", fitted},
    {MapKind::nonaffine, "nonaffine",
     "non-affine displacement: how far a grain's neighbours have moved beside their common strain", "D_m_i_n",
     "D", earlier | fitted},
    {MapKind::shear, "shear", "shear strain of the neighbourhood of each grain", "shear strain", "",
     earlier | fitted},
    {MapKind::dilation, "dilation", "change of area of the neighbourhood of each grain", "ΔA/A", "",
     earlier | fitted},
    {MapKind::vorticity, "vorticity", "how far the neighbourhood of each grain has turned, twice",
     "vorticity", "rad", earlier | fitted},
    {MapKind::coordination, "coordination", "contacts of each grain that carry force", "contacts", "", none},
    {MapKind::mobilised, "mobilised", "mobilised friction of each grain, the mean over its contacts",
     "|f_t| / μf_n", "", none},
    {MapKind::rigid, "rigid", "grains that can only move as one: the largest rigid cluster, and others", "",
     "", none},
    {MapKind::size, "size", "diameter of each grain", "diameter", "D", none},
    {MapKind::cells, "cells", "local solid fraction: the share of its cell that each grain fills",
     "solid fraction", "", none},
    {MapKind::density, "density", "coarse-grained solid fraction", "solid fraction", "", coarse},
    {MapKind::stress, "stress", "coarse-grained pressure, over rho g D", "P", "ρgD", coarse},
    {MapKind::shear_rate, "shear_rate", "coarse-grained shear rate, over sqrt(g / D)", "shear rate", "√(g/D)",
     coarse | fitted},
    {MapKind::temperature, "temperature", "granular temperature, over g D", "temperature", "gD",
     coarse | fitted},
    {MapKind::dyed, "dyed", "layers and columns as they were when the tilt began", "height as the tilt began",
     "D", none},
});

constexpr auto kinds = [] {
  std::array<MapKind, entries.size()> all{};
  for (std::size_t k = 0; k < entries.size(); ++k) all[k] = entries[k].kind;
  return all;
}();

const MapEntry& entry_of(MapKind kind) { return entries[static_cast<std::size_t>(kind)]; }

bool has(MapKind kind, Trait trait) { return (entry_of(kind).traits & trait) != 0; }

MapKind layer_of(std::string_view name, std::string_view whole) {
  const auto found = std::ranges::find(entries, name, &MapEntry::name);
  if (found != entries.end()) return found->kind;
  throw Error(
      ExitCode::usage,
      fmt::format("map '{}': expected one of {}, or two of them with + between, such as gamma+forces{}",
                  visible_word(whole), joined(entries, ", ", &MapEntry::name),
                  did_you_mean(name, names_of(entries))));
}

}  // namespace

std::span<const MapKind> map_kinds() { return kinds; }

std::string_view map_name(MapKind kind) { return entry_of(kind).name; }

std::string_view map_help(MapKind kind) { return entry_of(kind).help; }

MapReading map_reading(MapKind kind) { return {entry_of(kind).symbol, entry_of(kind).unit}; }

std::string list_of_maps() { return joined(entries, ", ", &MapEntry::name); }

bool needs_theta_c(MapKind kind) { return has(kind, theta_c); }
bool shows_gamma(MapKind kind) { return has(kind, gamma); }
bool is_coarse(MapKind kind) { return has(kind, coarse); }
bool needs_reference(MapKind kind) { return has(kind, earlier); }
bool fits_frames(MapKind kind) { return has(kind, fitted); }

bool shows(const MapLayers& layers, MapKind kind) { return std::ranges::count(layers, kind) > 0; }

bool any_layer(const MapLayers& layers, bool (*has)(MapKind)) { return std::ranges::any_of(layers, has); }

MapLayers map_layers(std::string_view name) {
  MapLayers layers;
  for (std::string_view rest = name;;) {
    const auto plus = rest.find('+');
    layers.push_back(layer_of(rest.substr(0, plus), name));
    if (plus == std::string_view::npos) break;
    rest.remove_prefix(plus + 1);
  }
  if (layers.size() > 2)
    throw Error(ExitCode::usage, fmt::format("map '{}': at most two can be overlaid", name));
  if (layers.size() == 2 && layers[0] == layers[1])
    throw Error(ExitCode::usage, fmt::format("map '{}': twice the same map", name));
  return layers;
}

std::string layers_name(const MapLayers& layers) { return joined(layers, "+", map_name); }

}  // namespace talus
