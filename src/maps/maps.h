#pragma once
/// Maps of the bed: from a frame of a run to what the renderer draws.

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/coarse_graining.h"
#include "core/snapshot.h"
#include "maps/cluster_colours.h"
#include "maps/map_kind.h"
#include "render/colour_map.h"
#include "render/frame_view.h"

namespace talus {

/// Ends of a scale.
struct ScaleRange {
  double low = 0.0, high = 1.0;
};

/// Ranges that fit how far grains have moved and turned in the frames that are drawn (MotionSample in
/// motion.h). Two of each, as the units differ: in all, and per degree of tilt. None where nothing moved.
struct MotionRanges {
  std::array<std::optional<ScaleRange>, 2> displacement, rotation;
};

/// What lies within them: the shares of grains below the ends of the scale of displacement, and that of
/// grains which have turned less than the ends of the scale of rotation.
inline constexpr struct { double low, high; } displacement_shares = {0.05, 0.99};
inline constexpr double rotation_share = 0.95;

/// The range of `displacement` or `rotation` where no other fits or is chosen: from the creep of a bed at
/// rest to an avalanche.
ScaleRange fixed_motion_range(MapKind kind, bool per_degree);

/// How the maps of a run are drawn; the same for all of its frames.
struct MapSettings {
  MapLayers layers;                  ///< one map, or two: the second is drawn over the first
  std::optional<ColourMap> colours;  ///< of the first layer that has a bar; without a value: its own
  std::optional<double> range_low;   ///< of the bar of that layer, in the unit of its title
  std::optional<double> range_high;
  MotionRanges motion;            ///< of `displacement` and `rotation` where no range is chosen
  double theta_c = 0.0;           ///< rad, angle of repose: Gamma_c = sin(theta_c)
  bool theta_c_assumed = false;   ///< the caption says so
  double threshold_factor = 1.0;  ///< grains are overloaded from this times Gamma_c on
  double l_min = default_l_min;   ///< D: diameter of the neighbourhood whose stress ratio is the gamma of a
                                  ///< grain; 0: the grain alone
  double length = 10.0;           ///< D: the diameter of neighbourhoods of the map `coarse`
  bool joined_by_neighbours = false;  ///< clusters: grains closer than 1.1 times the sum of their radii join,
                                      ///< instead of those that touch with a force
  bool turned = false;                ///< to its slope, instead of the bed's own frame
  double tilt_max = 0.0;              ///< rad, of all frames that are to have the size of this one
  bool furniture = true;
  bool transparent = false;
};

/// What the maps of one run show of the bed, so that all of them have the same size. m, frame of the bed.
struct MapExtent {
  double x_min = 0.0, x_max = 0.0, y_min = 0.0, y_max = 0.0;
};

/// The bed from end to end (x), and in y from the lowest to the highest grain of these frames: begin with
/// bed_extent, and extend by each frame.
MapExtent bed_extent(const RunStatics& statics);
void extend(MapExtent& extent, const Frame& frame, const RunStatics& statics);

/// A frame as its maps see it: gamma of a grain is that of its neighbourhood of diameter `settings.l_min`.
/// Maps, traces and clusters are all made from such a frame.
Frame mapped_frame(Frame frame, const RunStatics& statics, const MapSettings& settings);

/// Whose gamma a map shows, for its title: "l = 3 D", or "single grains" where l_min is 0.
std::string reading_text(const MapSettings& settings);

/// A frame, with what maps need beside it.
struct MapFrame {
  const Frame& frame;  ///< of mapped_frame, with the settings of the map
  const RunStatics& statics;
  /// For `displacement` and `rotation`: the frame that they are measured from, null where there is none yet
  /// (nothing has moved); and whether the map says what moved in a degree of tilt, or in all;
  /// always the latter where there was no tilt between them, as in a flow.
  const Frame* reference = nullptr;
  bool per_degree = true;
  /// For `clusters`: from a ClusterColours (cluster_colours.h) that has met all earlier frames; else empty.
  std::span<const ClusterColour> cluster_colours = {};
};

/// The bed of a frame without furniture, with a gray in [0, 1] for each free grain: 0 white, 1 black.
FrameView bare_map(const Frame& frame, const RunStatics& statics, std::span<const double> shades,
                   const MapExtent& extent);

/// A map of a frame, with its furniture but no traces. Throws Error(bad_data) where a layer is scaled by
/// theta_c, and that is not between 2 and 89 deg; Error(usage) where a range or `length` cannot be.
FrameView make_map(const MapFrame& frame, const MapSettings& settings, const MapExtent& extent);

/// Whether a map has a bar: whether `colours` and `range_low`, `range_high` change anything.
bool has_bar(const MapLayers& layers);

/// Stress ratio below which a grain is white in the map of gamma (paper, Fig. 10).
inline constexpr double white_below = 0.05;

/// Gray of a stress ratio: 0 (white) below white_below and for NaN, 1 (black) from 2 gamma_c on, linear
/// between. `gamma_c` > white_below / 2.
double gamma_shade(double gamma, double gamma_c);

}  // namespace talus
