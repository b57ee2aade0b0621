#pragma once
/// Maps of the bed: from a frame of a run to what the renderer draws.

#include <span>
#include <string_view>

#include "core/snapshot.h"
#include "render/frame_view.h"

namespace talus {

enum class MapKind {
  gamma,       ///< the stress ratio of each grain in gray (paper, Fig. 10)
  overloaded,  ///< grains with gamma >= Gamma_c in black (paper, Fig. 13)
};

/// The kind of that name. Throws Error(usage).
MapKind map_kind(std::string_view name);
std::string_view map_name(MapKind kind);

/// Stress ratio below which a grain is white in the map of gamma (paper, Fig. 10).
inline constexpr double white_below = 0.05;

/// Gray of a stress ratio: 0 (white) below white_below and for NaN, 1 (black) from 2 gamma_c on, linear
/// between. `gamma_c` > white_below / 2.
double gamma_shade(double gamma, double gamma_c);

/// What the maps of one run show of the bed, so that all of them have the same size.
struct MapExtent {
  double y_min = 0.0;  ///< m
  double y_max = 0.0;  ///< m
};

/// Lets the extent hold all grains of a frame.
void extend(MapExtent& extent, const Frame& frame, const RunStatics& statics);

/// The bed of a frame without furniture, with a shade in [0, 1] for each free grain.
FrameView bare_map(const Frame& frame, const RunStatics& statics, std::span<const double> shades,
                   const MapExtent& extent);

/// A map of a frame. `theta_c` is the angle of repose, rad, with Gamma_c = sin(theta_c).
/// Throws Error(bad_data) where no gray scale can be made of theta_c.
FrameView make_map(const Frame& frame, const RunStatics& statics, MapKind kind, double theta_c,
                   const MapExtent& extent);

}  // namespace talus
