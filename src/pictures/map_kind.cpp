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

struct MapEntry {
  MapKind kind;
  std::string_view name, help;
};

constexpr auto entries = std::to_array<MapEntry>({
    {MapKind::gamma, "gamma", "stress ratio of each grain and its neighbours, or of the grain alone"},
    {MapKind::overloaded, "overloaded", "overloaded grains, gamma >= Gamma_c"},
    {MapKind::clusters, "clusters", "clusters of overloaded grains, each in a colour of its own"},
    {MapKind::coarse, "coarse", "stress ratio of the neighbourhood of each grain"},
    {MapKind::pressure, "pressure", "pressure in each grain, over rho g D"},
    {MapKind::displacement, "displacement", "how far each grain has moved; over another map: arrows"},
    {MapKind::rotation, "rotation", "how far each grain has turned"},
    {MapKind::forces, "forces", "force chains: lines between centres, as wide as the normal force is large"},
    {MapKind::critical, "critical", "contacts with fully mobilised friction"},
    {MapKind::speed, "speed", "speed of each grain, over sqrt(g D)"},
    {MapKind::nonaffine, "nonaffine",
     "non-affine displacement: how far a grain's neighbours have moved beside their common strain"},
    {MapKind::shear, "shear", "shear strain of the neighbourhood of each grain"},
    {MapKind::dilation, "dilation", "change of area of the neighbourhood of each grain"},
    {MapKind::vorticity, "vorticity", "how far the neighbourhood of each grain has turned, twice"},
    {MapKind::coordination, "coordination", "contacts of each grain that carry force"},
    {MapKind::mobilised, "mobilised", "mobilised friction of each grain, the mean over its contacts"},
    {MapKind::rigid, "rigid", "grains that can only move as one: the largest rigid cluster, and others"},
    {MapKind::size, "size", "diameter of each grain"},
    {MapKind::cells, "cells", "local solid fraction: the share of its cell that each grain fills"},
    {MapKind::density, "density", "coarse-grained solid fraction"},
    {MapKind::stress, "stress", "coarse-grained pressure, over rho g D"},
    {MapKind::shear_rate, "shear_rate", "coarse-grained shear rate, over sqrt(g / D)"},
    {MapKind::temperature, "temperature", "granular temperature, over g D"},
    {MapKind::dyed, "dyed", "layers and columns as they were when the tilt began"},
});

constexpr auto kinds = [] {
  std::array<MapKind, entries.size()> all{};
  for (std::size_t k = 0; k < entries.size(); ++k) all[k] = entries[k].kind;
  return all;
}();

const MapEntry& entry_of(MapKind kind) { return entries[static_cast<std::size_t>(kind)]; }

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

MapReading map_reading(MapKind kind) {
  switch (kind) {
    case MapKind::gamma:
      return {"γ", ""};
    case MapKind::coarse:
      return {"γ_l", ""};
    case MapKind::pressure:
    case MapKind::stress:
      return {"P", "ρgD"};
    case MapKind::displacement:
      return {"displacement", "D"};
    case MapKind::rotation:
      return {"rotation", "°"};
    case MapKind::speed:
      return {"speed", "√(gD)"};
    case MapKind::nonaffine:
      return {"D_m_i_n", "D"};
    case MapKind::shear:
      return {"shear strain", ""};
    case MapKind::dilation:
      return {"ΔA/A", ""};
    case MapKind::vorticity:
      return {"vorticity", "rad"};
    case MapKind::coordination:
      return {"contacts", ""};
    case MapKind::mobilised:
      return {"|f_t| / μf_n", ""};
    case MapKind::size:
      return {"diameter", "D"};
    case MapKind::cells:
    case MapKind::density:
      return {"solid fraction", ""};
    case MapKind::shear_rate:
      return {"shear rate", "√(g/D)"};
    case MapKind::temperature:
      return {"temperature", "gD"};
    case MapKind::dyed:
      return {"height as the tilt began", "D"};
    case MapKind::overloaded:
    case MapKind::clusters:
    case MapKind::forces:
    case MapKind::critical:
    case MapKind::rigid:
      break;
  }
  return {"", ""};
}

std::string list_of_maps() { return joined(entries, ", ", &MapEntry::name); }

bool needs_theta_c(MapKind kind) { return shows_gamma(kind) || kind == MapKind::coarse; }

bool shows_gamma(MapKind kind) {
  return kind == MapKind::gamma || kind == MapKind::overloaded || kind == MapKind::clusters;
}

bool needs_reference(MapKind kind) {
  switch (kind) {
    case MapKind::displacement:
    case MapKind::rotation:
    case MapKind::nonaffine:
    case MapKind::shear:
    case MapKind::dilation:
    case MapKind::vorticity:
      return true;
    default:
      return false;
  }
}

bool fits_frames(MapKind kind) {
  return needs_reference(kind) || kind == MapKind::speed || kind == MapKind::shear_rate ||
         kind == MapKind::temperature;
}

bool is_coarse(MapKind kind) {
  return kind == MapKind::coarse || kind == MapKind::density || kind == MapKind::stress ||
         kind == MapKind::shear_rate || kind == MapKind::temperature;
}

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
