#pragma once
/// The plan of the maps of a run: checked options.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/run_file.h"
#include "pictures/map_options.h"
#include "pictures/maps.h"
#include "pictures/traces.h"
#include "render/context.h"

namespace talus::pictures {

// Ranges of the numbers of MapOptions, ends included.
inline constexpr ScaleRange theta_c_range = {2.0, 89.0};     // deg
inline constexpr ScaleRange l_min_range = {0.0, 100.0};      // D
inline constexpr ScaleRange threshold_range = {0.01, 10.0};  // multiples of Gamma_c
inline constexpr ScaleRange length_range = {1.0, 1000.0};    // D
inline constexpr ScaleRange since_range = {0.0, 90.0};       // deg
inline constexpr ScaleRange printed_range = {4.0, 200.0};    // cm

/// The request, as far as it is independent of the run: theta_c is NaN if that of the run is to be used.
struct MapPlan {
  std::vector<MapSettings> maps;
  std::vector<TraceKind> traces;
  std::optional<MapExtent> crop;  ///< D, from the left end of the bed on the floor
  std::optional<double> since;    ///< rad
  std::optional<render::ContextKind> context;
  int width = 0, height = 0;  ///< px; height 0: follows from the bed
  /// Returns the width of the picture in print, m; 0 for a screen.
  double page_width() const { return maps.empty() ? 0.0 : maps[0].printed / 100.0; }
};

/// Makes a plan, in which quantities of scripts are maps too. Throws Error(usage) if an option names
/// something that does not exist or is out of its range, or two exclude each other.
MapPlan plan_maps(const MapOptions& options, std::span<const OwnQuantity> own = {});
/// Makes a plan for the run at `path`, which is opened if it exists and Talus alone has no such plan. Throws
/// also the errors of RunFile::open.
MapPlan plan_maps(const MapOptions& options, const std::string& path);

/// Returns the quantities stored with a run as own quantities of MapSettings, with the ends of their scales.
std::vector<OwnQuantity> stored_maps(const io::RunFile& run);
/// Sets the layers of a map by its name: one or two maps of Talus, or one of these quantities, alone or below
/// a map. Throws the errors of map_layers.
void choose_map(MapSettings& map, const std::string& name, std::span<const OwnQuantity> own);

/// Whether any layer of any map has the property.
bool any_layer(const MapPlan& plan, bool (*has)(MapKind));
bool shows(const MapPlan& plan, MapKind kind);
/// Whether a map or a trace depends on Gamma_c.
bool needs_theta_c(const MapPlan& plan);
/// Whether a map or a trace depends on the gamma of grains.
bool shows_gamma(const MapPlan& plan);

}  // namespace talus::pictures
