#pragma once
/// What each kind of map shows of a frame: a layer. make_map composes one or two of them.

#include <optional>
#include <string>
#include <vector>

#include "pictures/maps.h"
#include "pictures/scale.h"

namespace talus::pictures {

/// Grains, or lines, and what explains them.
struct MapLayer {
  std::string title;                ///< begins with a capital
  std::vector<GrainLook> looks;     ///< of each free grain; empty: the layer has lines only
  std::vector<render::Line> lines;  ///< without copies across a periodic edge
  render::Legend legend;
  std::vector<double> values{};  ///< of each free grain, where looks follow from a value: by this scale
  std::optional<Scale> scale{};
};

// maps.cpp
/// Layer k of the settings.
MapLayer make_layer(const MapFrame& of, const MapSettings& settings, const MapExtent& extent, std::size_t k);
/// Of lines over layer k: black, or, where its grains can be dark, what tells from its colours, and from
/// black and white also in gray.
render::Colour colour_over(const MapSettings& settings, std::size_t k);
/// "θ = 12.25°, θ_c = 19.52°", with "(assumed)" where it is.
std::string caption_of(const Frame& frame, const MapSettings& settings);

/// The bar with what it measures of each free grain.
render::Bar measuring(render::Bar bar, std::vector<double> values);

/// Grains in the colours of their values.
MapLayer scaled_layer(const std::string& title, const Scale& scale, std::vector<double> values,
                      const render::Bar& bar);
/// The same where those without a value (NaN) only show where they are.
MapLayer scaled_layer_with_outlines(const std::string& title, const Scale& scale, std::vector<double> values,
                                    const render::Bar& bar);

/// The map that layers make of a frame, with its furniture: what make_map does of those of its settings.
render::FrameView compose_map(const MapFrame& frame, const MapSettings& settings, const MapExtent& extent,
                              std::vector<MapLayer> layers);

// stress_layers.cpp
MapLayer gamma_layer(const MapFrame& of, const MapSettings& settings, const ScaleChoice& choice);
MapLayer coarse_layer(const MapFrame& of, const MapSettings& settings, const ScaleChoice& choice);

// overload_layers.cpp; `over_grains`: as marks in grains that another layer fills.
MapLayer overloaded_layer(const MapFrame& of, const MapSettings& settings, bool over_grains);
MapLayer clusters_layer(const MapFrame& of, const MapSettings& settings, bool over_grains);

// value_layers.cpp
/// A map of shown_quantity. Throws Error(internal) for others.
MapLayer value_layer(MapKind kind, const MapFrame& of, const MapSettings& settings,
                     const ScaleChoice& choice);
/// What it shows of each free grain, in the unit of map_reading, and per degree where motion_span is; NaN
/// where there is no value, 0 or NaN without a reference that it needs.
std::vector<double> map_values(MapKind kind, const MapFrame& of, const MapSettings& settings);

// grain_layers.cpp
MapLayer size_layer(const MapFrame& of, const ScaleChoice& choice);
MapLayer dyed_layer(const MapFrame& of, const ScaleChoice& choice);

/// The colour of lines over grains that another layer fills; none where they are outlines.
using OverColour = std::optional<render::Colour>;

/// D: of lines over filled grains. With it they are told from grains of any shade, in gray print too.
inline constexpr double line_border = 0.06;
/// Gives lines that cannot be seen through a white border of that width, m, below all of them.
void add_borders(std::vector<render::Line>& lines, double border);

// motion_layers.cpp
/// Of every free grain; or of one in each square of `spacing` (m) where that is more than D, and longer by
/// it. Lengths are the displacements times a round number, which the legend says; the longest are cut.
MapLayer displacement_arrows(const MapFrame& of, const MotionRanges& motion, const OverColour& over,
                             double spacing);

// contact_layers.cpp
/// D: half the width of the line of a contact with the mean force, and the largest force that is told from
/// others, over the mean: then the line is nearly as wide as the smallest grains.
inline constexpr struct { double half_width, widest; } force_lines = {0.05, 6.0};
/// D: the line of a contact whose friction is fully mobilised.
inline constexpr struct { double length, half_width; } critical_lines = {0.7, 0.11};
MapLayer forces_layer(const MapFrame& of, const OverColour& over);
MapLayer critical_layer(const MapFrame& of, const OverColour& over);

// support_layers.cpp: how contacts hold each grain; `over_grains` as above
MapLayer coordination_layer(const MapFrame& of, const ScaleChoice& choice);
MapLayer rigid_layer(const MapFrame& of, bool over_grains);

/// What coarse maps average over, m, a diameter. Throws Error(usage) where it is more than the bed.
double coarse_length(const MapFrame& of, const MapSettings& settings);

/// Gamma_c = sin(theta_c).
double gamma_c_of(const MapSettings& settings);

}  // namespace talus::pictures
