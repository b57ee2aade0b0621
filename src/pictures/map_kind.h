#pragma once
/// The maps that there are, and their names: what is drawn by rules of its own, and each quantity of grains
/// whose row says how (MapRule).

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/frame_quantities.h"

namespace talus::pictures {

/// Quantities of grains that no code names have numbers beyond these.
enum class MapKind {
  gamma,         ///< stress ratio of each grain (paper, Fig. 10)
  overloaded,    ///< grains with gamma >= Gamma_c (paper, Fig. 13)
  clusters,      ///< overloaded grains by cluster, each keeps its colour from frame to frame
  coarse,        ///< gamma_l: the stress ratio of the neighbourhood of each grain, of a chosen diameter
  pressure,      ///< p of each grain, over rho g D
  displacement,  ///< how far each grain has moved in the frame of the bed; as upper layer, arrows
  rotation,      ///< how far it has turned
  forces,        ///< force chains: lines between centres, width by normal force, strong and weak apart
  critical,      ///< contacts with fully mobilised friction
  speed,         ///< of each grain, over sqrt(g D)
  nonaffine,     ///< what a grain's neighbours moved beside any uniform deformation (local_deformation.h)
  shear,         ///< shear strain of its neighbourhood
  dilation,      ///< area strain of its neighbourhood
  vorticity,     ///< turn of its neighbourhood
  coordination,  ///< contacts of each grain that carry force
  mobilised,     ///< mean mobilised friction of its contacts
  rigid,         ///< rigid clusters of grains
  size,          ///< diameter of each grain
  cells,         ///< local solid fraction: of each grain in its cell
  density,       ///< coarse-grained solid fraction, of a chosen width
  stress,        ///< coarse-grained pressure, over rho g D
  shear_rate,    ///< coarse-grained, over sqrt(g / D)
  temperature,   ///< granular temperature, over g D
  dyed,          ///< layers and columns of grains as they were when the tilt began
};

/// All of them, in the order in which they are listed to users.
std::span<const MapKind> map_kinds();

std::string_view map_name(MapKind kind);
/// A line for users: what the map shows.
std::string_view map_help(MapKind kind);
/// What the bar of a map measures, as rich texts: "v" and "√(gD)". Empty where a map has no bar, and the unit
/// of a ratio.
struct MapReading {
  std::string symbol, unit;
};
MapReading map_reading(MapKind kind, const RunStatics& statics);
/// Whether it has a bar; whether its scale goes to either side of 0.
bool is_scaled(MapKind kind);
bool is_signed(MapKind kind);
/// The quantity of grains that it shows by its MapRule; null for a map with rules of its own.
const analysis::FrameQuantity* shown_quantity(MapKind kind);
/// The names of all: "gamma, overloaded, ...".
std::string list_of_maps();

/// Whether its scale or its threshold is Gamma_c.
bool needs_theta_c(MapKind kind);
/// Whether it shows the gamma of grains, or what follows from it: whether MapSettings::l_min changes it.
bool shows_gamma(MapKind kind);
/// Whether it is an average around each grain, of a chosen width: whether MapSettings::length changes it.
bool is_coarse(MapKind kind);
/// Whether it is measured from an earlier frame.
bool needs_reference(MapKind kind);
/// Whether its range fits the frames that are drawn: of what is measured from an earlier frame, and of
/// velocities.
bool fits_frames(MapKind kind);

/// One map, or two overlaid: the lower first.
using MapLayers = std::vector<MapKind>;

bool shows(const MapLayers& layers, MapKind kind);
/// Whether one of them has it.
bool any_layer(const MapLayers& layers, bool (*has)(MapKind));

/// The layers of a name: "gamma", or "gamma+forces". Throws Error(usage) with the names that there are at an
/// unknown one, and where there are more than two, or twice the same.
MapLayers map_layers(std::string_view name);
/// "gamma+forces", which is also what files are called.
std::string layers_name(const MapLayers& layers);

}  // namespace talus::pictures
