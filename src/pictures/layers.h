#pragma once
/// The layer that each kind of map makes of a frame; make_map composes one or two of them.

#include <optional>
#include <string>
#include <vector>

#include "pictures/maps.h"
#include "pictures/scale.h"

namespace talus::pictures {

/// Grains or lines, and their legend.
struct MapLayer {
  std::string title;                ///< begins with a capital letter
  std::vector<GrainStyle> styles;   ///< one for each free grain; empty: the layer has lines only
  std::vector<render::Line> lines;  ///< without copies across a periodic edge
  render::Legend legend;
  std::vector<double> values{};  ///< one for each free grain, if values on `scale` determine their looks
  std::optional<Scale> scale{};
};

// maps.cpp
/// Returns layer k of the settings.
MapLayer make_layer(const MapFrame& bed, const MapSettings& settings, const MapExtent& extent, std::size_t k);
/// Returns the colour of lines over layer k: black, or, if its grains can be dark, a colour that differs from
/// theirs and, also in gray, from black and white.
render::Colour colour_over(const MapSettings& settings, std::size_t k);
/// Returns "θ = 12.25°, θ_c = 19.52°", with "(assumed)" if it is.
std::string caption_of(const Frame& frame, const MapSettings& settings);

/// Returns the bar with the measured value of each free grain.
render::Bar measuring(render::Bar bar, std::vector<double> values);

/// Returns a layer of grains in the colours of their values.
MapLayer scaled_layer(const std::string& title, const Scale& scale, std::vector<double> values,
                      const render::Bar& bar);
/// Returns a layer in which grains without a value (NaN) are outlines.
MapLayer scaled_layer_with_outlines(const std::string& title, const Scale& scale, std::vector<double> values,
                                    const render::Bar& bar);

/// Returns the map of these layers of a frame, with its furniture, as make_map does for the layers of its
/// settings.
render::FrameView compose_map(const MapFrame& frame, const MapSettings& settings, const MapExtent& extent,
                              std::vector<MapLayer> layers);

// stress_layers.cpp
MapLayer gamma_layer(const MapFrame& bed, const MapSettings& settings, const ScaleChoice& choice);
MapLayer coarse_layer(const MapFrame& bed, const MapSettings& settings, const ScaleChoice& choice);

// overload_layers.cpp; `over_grains`: as marks in grains that another layer fills
MapLayer overloaded_layer(const MapFrame& bed, const MapSettings& settings, bool over_grains);
MapLayer clusters_layer(const MapFrame& bed, const MapSettings& settings, bool over_grains);

// value_layers.cpp
/// Returns a map of shown_quantity. Throws Error(internal) for other kinds.
MapLayer value_layer(MapKind kind, const MapFrame& bed, const MapSettings& settings,
                     const ScaleChoice& choice);
/// Returns the value of each free grain, in the unit of map_reading, per degree if motion_span is; NaN if
/// there is no value, and 0 or NaN without a required reference.
std::vector<double> map_values(MapKind kind, const MapFrame& bed, const MapSettings& settings);

// grain_layers.cpp
MapLayer size_layer(const MapFrame& bed, const ScaleChoice& choice);
MapLayer dyed_layer(const MapFrame& bed, const ScaleChoice& choice);

/// The colour of lines over grains that another layer fills; none if they are outlines.
using OverColour = std::optional<render::Colour>;

/// D: width of the border of lines over filled grains. It separates them from grains of any shade, also in a
/// gray print.
inline constexpr double line_border = 0.06;
/// Adds a white border of that width, m, to opaque lines, below all of them.
void add_borders(std::vector<render::Line>& lines, double border);

// motion_layers.cpp
/// Returns an arrow for each free grain, or for one in each square of side `spacing` (m) if that exceeds D;
/// arrows are then longer in proportion. Lengths are the displacements times a round factor, which the legend
/// states; the longest are cut.
MapLayer displacement_arrows(const MapFrame& bed, const MotionRanges& motion, const OverColour& over,
                             double spacing);

// contact_layers.cpp
/// D: half the width of the line of a contact with the mean force, and the largest distinguishable force over
/// the mean, at which the line is nearly as wide as the smallest grains.
inline constexpr struct { double half_width, widest; } force_lines = {0.05, 6.0};
/// D: the line of a contact with fully mobilised friction.
inline constexpr struct { double length, half_width; } critical_lines = {0.7, 0.11};
MapLayer forces_layer(const MapFrame& bed, const OverColour& over);
MapLayer critical_layer(const MapFrame& bed, const OverColour& over);

// support_layers.cpp: how contacts support each grain; `over_grains` as above
MapLayer coordination_layer(const MapFrame& bed, const ScaleChoice& choice);
MapLayer rigid_layer(const MapFrame& bed, bool over_grains);

/// Returns the diameter over which coarse maps average, m. Throws Error(usage) if it exceeds the bed.
double coarse_length(const MapFrame& bed, const MapSettings& settings);

/// Returns Gamma_c = sin(theta_c).
double gamma_c_of(const MapSettings& settings);

}  // namespace talus::pictures
