#pragma once
/// What each kind of map shows of a frame: a layer. make_map composes one or two of them.

#include <optional>
#include <string>
#include <vector>

#include "pictures/maps.h"
#include "pictures/scale.h"

namespace talus {

/// Grains, or lines, and what explains them.
struct MapLayer {
  std::string title;             ///< begins with a capital
  std::vector<GrainLook> looks;  ///< of each free grain; empty: the layer has lines only
  std::vector<Line> lines;       ///< without copies across a periodic edge
  Legend legend;
};

// stress_layers.cpp
MapLayer gamma_layer(const MapFrame& of, const MapSettings& settings, const ScaleChoice& choice);
MapLayer coarse_layer(const MapFrame& of, const MapSettings& settings, const ScaleChoice& choice);
MapLayer pressure_layer(const MapFrame& of, const ScaleChoice& choice);

// overload_layers.cpp; `over_grains`: as marks in grains that another layer fills.
MapLayer overloaded_layer(const MapFrame& of, const MapSettings& settings, bool over_grains);
MapLayer clusters_layer(const MapFrame& of, const MapSettings& settings, bool over_grains);

// motion_layers.cpp; a map with needs_reference
MapLayer motion_layer(MapKind kind, const MapFrame& of, const MotionRanges& motion,
                      const ScaleChoice& choice);

// grain_layers.cpp
MapLayer speed_layer(const MapFrame& of, const ScaleChoice& choice);
MapLayer size_layer(const MapFrame& of, const ScaleChoice& choice);
MapLayer dyed_layer(const MapFrame& of, const ScaleChoice& choice);

/// The colour of lines over grains that another layer fills; none where they are outlines.
using OverColour = std::optional<Colour>;

/// Of every free grain; or of one in each square of `spacing` (m) where that is more than D, and longer by
/// it.
MapLayer displacement_arrows(const MapFrame& of, const MotionRanges& motion, const OverColour& over,
                             double spacing);

// field_layers.cpp; the bed as a continuum, at the centre of each grain
MapLayer cells_layer(const MapFrame& of, const ScaleChoice& choice);
MapLayer field_layer(MapKind kind, const MapFrame& of, const MapSettings& settings,
                     const ScaleChoice& choice);

// contact_layers.cpp
MapLayer forces_layer(const MapFrame& of, const OverColour& over);
MapLayer critical_layer(const MapFrame& of, const OverColour& over);

// support_layers.cpp: how contacts hold each grain; `over_grains` as above
MapLayer coordination_layer(const MapFrame& of, const ScaleChoice& choice);
MapLayer mobilised_layer(const MapFrame& of, const ScaleChoice& choice);
MapLayer rigid_layer(const MapFrame& of, bool over_grains);

/// What coarse maps average over, m, a diameter. Throws Error(usage) where it is more than the bed.
double coarse_length(const MapFrame& of, const MapSettings& settings);

/// Gamma_c = sin(theta_c).
double gamma_c_of(const MapSettings& settings);

}  // namespace talus
