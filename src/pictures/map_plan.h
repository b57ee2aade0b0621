#pragma once
/// Which maps of a run are drawn, and how: as asked for in words, and checked.

#include <optional>
#include <string>
#include <vector>

#include "pictures/map_options.h"
#include "pictures/maps.h"
#include "pictures/traces.h"
#include "render/context.h"

namespace talus::pictures {

/// A region of the bed in D: the origin is its left end on the floor.
struct Crop {
  double x0 = 0.0, y0 = 0.0, x1 = 0.0, y1 = 0.0;
};

/// What is asked for, as far as it can be said without the run: theta_c is NaN where it is that of the run.
struct MapPlan {
  std::vector<MapSettings> maps;
  std::vector<TraceKind> traces;
  std::optional<Crop> crop;
  std::optional<double> since;  ///< rad
  std::optional<render::ContextKind> context;
  int width = 0;  ///< px
  /// m: of the picture in print; of one for a screen 0.
  double page_width() const { return maps.empty() ? 0.0 : maps[0].printed / 100.0; }
};

/// Throws Error(usage) where an option names something that does not exist, or two do not go together.
MapPlan plan_maps(const MapOptions& options);

/// Of all layers of all maps.
bool any_layer(const MapPlan& plan, bool (*has)(MapKind));
bool shows(const MapPlan& plan, MapKind kind);
/// Whether a map or a trace goes by Gamma_c.
bool needs_theta_c(const MapPlan& plan);
/// Whether a map or a trace goes by the gamma of grains.
bool shows_gamma(const MapPlan& plan);

}  // namespace talus::pictures
