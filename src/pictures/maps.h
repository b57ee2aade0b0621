#pragma once
/// Maps of the bed: from a frame of a run to what the renderer draws.

#include <array>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/bed_frame.h"
#include "pictures/cluster_colours.h"
#include "pictures/map_kind.h"
#include "pictures/overload_rule.h"
#include "pictures/scale.h"
#include "render/colour_map.h"
#include "render/frame_view.h"

namespace talus::pictures {

/// Ends of a scale.
struct ScaleRange {
  double low = 0.0, high = 1.0;
  bool operator==(const ScaleRange&) const = default;
};

/// Ranges that fit what maps of motion (fits_frames) show in the frames that are drawn (MotionSample in
/// motion.h). Two of each, as the units differ: in all, and per degree of tilt; velocities have the first.
/// None where nothing moved.
struct MotionRanges {
  std::map<MapKind, std::array<std::optional<ScaleRange>, 2>> fitting;

  std::optional<ScaleRange> of(MapKind kind, bool per_degree) const {
    const auto found = fitting.find(kind);
    return found == fitting.end() ? std::nullopt : found->second[per_degree];
  }
  bool operator==(const MotionRanges&) const = default;
};

/// What lies within them: the shares of grains below the ends of a logarithmic scale, as that of displacement
/// is, and that of grains which have less than the ends of one with a sign, as that of rotation.
inline constexpr struct { double low, high; } size_shares = {0.05, 0.99};
inline constexpr double signed_share = 0.95;

/// The range of a map of motion (fits_frames) if no other fits or is chosen: from the creep of a bed at rest
/// to an avalanche.
ScaleRange fixed_motion_range(MapKind kind, bool per_degree);

/// deg: by which maps are scaled while the slope has not failed and nothing else is asked for.
inline constexpr double assumed_theta_c = 20.0;

/// How the maps of a run are drawn; the same for all of its frames.
struct MapSettings : OverloadRule {
  MapLayers layers;                          ///< one map, or two: the second is drawn over the first
  std::optional<render::ColourMap> colours;  ///< of the first layer that has a bar; without a value: its own
  ClusterPalette palette = ClusterPalette::muted;
  std::optional<double> range_low;  ///< of the bar of that layer, in the unit of its title
  std::optional<double> range_high;
  MotionRanges motion;           ///< of maps of motion where no range is chosen
  bool theta_c_assumed = false;  ///< the caption says so
  double length = 10.0;          ///< D: what coarse maps (is_coarse) average over, a diameter
  bool turned = false;           ///< to its slope, instead of the bed's own frame
  double tilt_max = 0.0;         ///< rad, of all frames that are to have the size of this one
  bool furniture = true;
  bool transparent = false;
  double printed = 0.0;  ///< cm, how wide the picture is printed or projected; 0: it is for a screen
  double points = 8.0;   ///< size of its letters there
  bool operator==(const MapSettings&) const = default;
};

/// What the maps of one run show of the bed, so that all of them have the same size. m, frame of the bed.
struct MapExtent {
  double x_min = 0.0, x_max = 0.0, y_min = 0.0, y_max = 0.0;
  bool operator==(const MapExtent&) const = default;
};

/// The bed from end to end (x), and in y from the lowest to the highest grain of these frames: begin with
/// bed_extent, and extend by each frame.
MapExtent bed_extent(const RunStatics& statics);
void extend(MapExtent& extent, const BedFrame& bed);
/// The same by the lowest and the highest grain of other frames.
void extend(MapExtent& extent, const MapExtent& other);

/// Whose gamma a map shows, for its title: "l = 3 D", or "single grains" where l_min is 0.
std::string reading_text(const OverloadRule& rule);

/// A frame of mapped_frame, with the l_min of the map, and what maps need beside it.
struct MapFrame : BedFrame {
  /// For maps of motion: the frame that they are measured from, null where there is none yet
  /// (nothing has moved); and whether the map says what moved in a degree of tilt, or in all;
  /// always the latter where there was no tilt between them, as in a flow.
  const Frame* reference = nullptr;
  bool per_degree = true;
  /// For `clusters`: from a ClusterColours (cluster_colours.h) that has met all earlier frames. Where there
  /// are none, colours follow those of the last frame that `tracker` has met; null: it has met none.
  std::span<const ClusterColour> cluster_colours = {};
  const ClusterColours* tracker = nullptr;
  /// For `dyed`: where grains were when the tilt began, m; one without is where it is now.
  std::span<const Vec2> dyed_at = {};
};

/// The outlines of the grains of a frame, without furniture.
render::FrameView outlined_bed(const BedFrame& bed, const MapExtent& extent);

/// A map of a frame, with its furniture but no traces. Throws Error(bad_data) where a layer is scaled by
/// theta_c, and that is not between 2 and 89 deg; Error(usage) where a range or `length` cannot be.
render::FrameView make_map(const MapFrame& frame, const MapSettings& settings, const MapExtent& extent);

/// Sets the letters of a view that is printed so wide (cm): of so many points, and of no less than 7/8 of
/// that.
void print_letters(render::FrameView& view, double width, double points);

/// Whether a map has a bar: whether `colours` and `range_low`, `range_high` change anything.
bool has_bar(const MapLayers& layers);

/// Stress ratio below which a grain is white in the map of gamma (paper, Fig. 10).
inline constexpr double white_below = 0.05;

}  // namespace talus::pictures
