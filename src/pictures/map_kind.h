#pragma once
/// The maps and their names: those with rules of their own, and one for each quantity with a MapRule.

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "analysis/frame_quantities.h"

namespace talus::pictures {

/// Quantities of grains that are not named here have larger values.
enum class MapKind {
  gamma,         ///< stress ratio of each grain (paper, Fig. 10)
  overloaded,    ///< grains with gamma >= Gamma_c (paper, Fig. 13)
  clusters,      ///< overloaded grains by cluster; each keeps its colour from frame to frame
  coarse,        ///< gamma_l: the stress ratio of the neighbourhood of each grain, with a chosen diameter
  pressure,      ///< p of each grain, over rho g D
  displacement,  ///< displacement of each grain in the frame of the bed; arrows as an upper layer
  rotation,      ///< rotation of each grain
  forces,     ///< force chains: lines between centres, width by normal force, strong and weak distinguished
  critical,   ///< contacts with fully mobilised friction
  speed,      ///< speed of each grain, over sqrt(g D)
  nonaffine,  ///< motion of a grain's neighbours in addition to any uniform deformation
              ///< (analysis/deformation/deformation.h)
  shear,      ///< shear strain of its neighbourhood
  dilation,   ///< area strain of its neighbourhood
  vorticity,  ///< rotation of its neighbourhood
  coordination,  ///< number of contacts of each grain that carry force
  mobilised,     ///< mean mobilised friction of its contacts
  rigid,         ///< rigid clusters of grains
  size,          ///< diameter of each grain
  cells,         ///< local solid fraction of each grain in its cell
  density,       ///< coarse-grained solid fraction, with a chosen width
  stress,        ///< coarse-grained pressure, over rho g D
  shear_rate,    ///< coarse-grained shear rate, over sqrt(g / D)
  temperature,   ///< granular temperature, over g D
  dyed,          ///< layers and columns of grains as they were when the tilt began
};

/// Returns all maps, in the order in which they are listed to users.
std::span<const MapKind> map_kinds();

std::string_view map_name(MapKind kind);
/// Returns one line of help: what the map shows.
std::string_view map_help(MapKind kind);
/// Returns symbol and unit of a map's bar as rich texts: "v" and "√(gD)". Both are empty if the map has no
/// bar, and the unit is empty for a ratio.
std::pair<std::string, std::string> map_reading(MapKind kind, const RunStatics& statics);
/// Whether it has a bar, and whether its scale extends to both sides of 0.
bool is_scaled(MapKind kind);
bool is_signed(MapKind kind);
/// Returns the quantity of grains that it shows by its MapRule; null for a map with its own rules.
const analysis::FrameQuantity* shown_quantity(MapKind kind);
/// Returns the names of all maps: "gamma, overloaded, ...".
std::string list_of_maps();

/// Whether its scale or its threshold is Gamma_c.
bool needs_theta_c(MapKind kind);
/// Whether it shows the gamma of grains or a result derived from it, and so depends on MapSettings::l_min.
bool shows_gamma(MapKind kind);
/// Whether it is an average around each grain over a chosen width, and so depends on MapSettings::length.
bool is_coarse(MapKind kind);
/// Whether it is measured from an earlier frame.
bool needs_reference(MapKind kind);
/// Whether its range fits the frames that are drawn, as for velocities and motion.
bool fits_frames(MapKind kind);

/// One map, or two overlaid maps, the lower one first.
using MapLayers = std::vector<MapKind>;

bool shows(const MapLayers& layers, MapKind kind);
/// Whether one of the layers has the property.
bool any_layer(const MapLayers& layers, bool (*has)(MapKind));

/// Returns the layers of a name: "gamma", or "gamma+forces". Throws Error(usage) for an unknown name, listing
/// the valid ones and those of scripts, for more than two layers, and for a repeated layer.
MapLayers map_layers(std::string_view name, std::span<const OwnQuantity> own = {});
/// Returns "gamma+forces", which is also used in file names.
std::string layers_name(const MapLayers& layers);

}  // namespace talus::pictures
