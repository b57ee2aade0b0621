#pragma once
/// Which maps of a run are drawn, and how: as asked for in words, and checked.

#include <optional>
#include <string>
#include <vector>

#include "pictures/maps.h"
#include "pictures/traces.h"
#include "render/context.h"

namespace talus {

/// The words and numbers of the options that `talus render`, `animate`, `panel` and `run --frames` share.
struct MapOptions {
  std::vector<std::string> maps;
  int width = 1600;                   ///< px
  std::optional<double> theta_c;      ///< deg
  std::string colours;                ///< empty: each map its own
  std::string context = "auto";       ///< or osmesa, egl
  std::optional<double> l_min;        ///< D
  std::optional<double> threshold;    ///< of Gamma_c
  std::optional<double> length;       ///< D
  std::optional<double> since;        ///< deg
  std::optional<std::string> joined;  ///< contacts or neighbours
  std::vector<double> range;          ///< low, high
  std::vector<double> crop;           ///< x0, y0, x1, y1 in D
  std::string traces;                 ///< with commas
  bool turned = false;
  bool transparent = false;
  bool bare = false;
  std::optional<double> printed;  ///< cm
};

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
  std::optional<ContextKind> context;
  int width = 0;  ///< px
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

}  // namespace talus
