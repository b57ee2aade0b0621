#pragma once
/// Maps of the bed: they convert a frame of a run to the input of the renderer.

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/frame_quantities.h"
#include "core/snapshot.h"
#include "pictures/cluster_colours.h"
#include "pictures/map_kind.h"
#include "pictures/map_options.h"
#include "pictures/scale.h"
#include "render/colour.h"
#include "render/frame_view.h"

namespace talus::pictures {

/// The ends of a scale, or of the range of an option.
struct ScaleRange {
  double low = 0.0, high = 1.0;
  bool operator==(const ScaleRange&) const = default;
};

/// Ranges that fit the values of maps of motion (fits_frames) in the frames that are drawn (see MotionSample
/// in layers.h). There are two for each map: of the total motion, and of the motion per degree of tilt;
/// velocities have only the first. Empty if nothing moved.
struct MotionRanges {
  std::map<MapKind, std::array<std::optional<ScaleRange>, 2>> fitting;

  std::optional<ScaleRange> range(MapKind kind, bool per_degree) const {
    const auto found = fitting.find(kind);
    return found == fitting.end() ? std::nullopt : found->second[per_degree];
  }
  bool operator==(const MotionRanges&) const = default;
};

/// Quantiles that define these ranges: the fractions of grains below the ends of a logarithmic scale, such as
/// that of displacement; and that within the ends of a signed scale, such as that of rotation.
inline constexpr struct { double low, high; } size_shares = {0.05, 0.99};
inline constexpr double signed_share = 0.95;

/// Returns the range of a map of motion if no other is fitted or chosen: from creep to an avalanche.
ScaleRange fixed_motion_range(MapKind kind, bool per_degree);

/// deg: the scale of maps while the slope has not failed, unless another is requested.
inline constexpr double assumed_theta_c = 20.0;

/// The settings of the maps of a run, the same for all of its frames.
struct MapSettings : OverloadRule {
  MapLayers layers;  ///< one map, or two: the second is drawn over the first
  /// A quantity of scripts drawn in place of the first layer, which is a map with the same options; its
  /// values are the ends of the default scale, if any.
  std::optional<OwnQuantity> own;
  std::optional<render::ColourMap> colours;  ///< colours of the first layer with a bar; not set: its default
  ClusterPalette palette = ClusterPalette::muted;
  std::optional<double> range_low;  ///< range of the bar of that layer, in the unit of its title
  std::optional<double> range_high;
  MotionRanges motion;           ///< ranges of maps of motion if no range is chosen
  bool theta_c_assumed = false;  ///< stated in the caption
  double length = 10.0;          ///< D: diameter over which coarse maps (is_coarse) average
  bool turned = false;           ///< drawn at its slope, instead of in the frame of the bed
  double tilt_max = 0.0;         ///< rad, maximum over all frames that are to have the same size
  bool furniture = true;
  bool transparent = false;
  double printed = 0.0;  ///< cm, width of the picture in print or projection; 0: for a screen
  double points = 8.0;   ///< size of its letters at that width
  bool operator==(const MapSettings&) const = default;
};

/// Returns the name of a map, which is also used in file names: "gamma+forces".
std::string name_of(const MapSettings& map);
/// Whether its clusters or labels have the colours of a palette.
bool has_palette(const MapSettings& map);

/// The part of the bed that the maps of a run show, so that all have the same size. m, frame of the bed.
struct MapExtent {
  double x_min = 0.0, x_max = 0.0, y_min = 0.0, y_max = 0.0;
  bool operator==(const MapExtent&) const = default;
};

/// Return and enlarge an extent: the bed from end to end (x), and in y from the lowest to the highest grain
/// of these frames. Begin with bed_extent, and extend it by each frame.
MapExtent bed_extent(const RunStatics& statics);
void extend(MapExtent& extent, const BedFrame& bed);
/// Extends an extent by the lowest and the highest grain of other frames.
void extend(MapExtent& extent, const MapExtent& other);

/// Returns the neighbourhood of gamma for the title of a map: "l = 3 D", or "single grains" if l_min is 0.
std::string reading_text(const OverloadRule& rule);

/// Step, time and tilt of a frame.
struct FrameInstant {
  std::int64_t step = 0;
  double time = 0.0;  ///< s
  double tilt = 0.0;  ///< rad
};

/// Data on the frames of a run added so far, in their order.
struct SeenFrames {
  std::vector<FrameInstant> instants;
  std::size_t highest = 0;  ///< last frame of the tilt; later ones belong to the flow
  OverloadRule rule;        ///< rule that defines their clusters
  std::vector<std::vector<ClusterColour>> cluster_colours;  ///< empty if no map shows them
  ClusterColours tracker;
  std::vector<Vec2> begin;  ///< positions of the grains in the first frame, m
};

/// Returns the outlines of the grains of a frame, without furniture.
render::FrameView outlined_bed(const BedFrame& bed, const MapExtent& extent);

/// Returns a map of a frame of mapped_frame, with its furniture but without traces. Clusters have the colours
/// of `seen` or, if the frame is not among these, the colours that follow them. Grains of the map `dyed` have
/// the colours of their first positions, or of the current ones if these are unknown. Maps of motion show
/// total motion if the tilt did not change since the earlier frame, as in a flow. Throws Error(bad_data) if a
/// layer is scaled by theta_c and theta_c is not between 2 and 89 deg; Error(usage) if a range or `length` is
/// invalid.
render::FrameView make_map(const analysis::GrainSource& frame, const MapSettings& settings,
                           const MapExtent& extent, const SeenFrames* seen = nullptr);

/// Throws Error(usage), which names `what` it is, if a text has letters that pictures lack.
void check_text(const std::string& what, const std::string& text);

/// Sets the letters of a view printed at this width (cm) to this size in points, at least 7/8 of it.
void print_letters(render::FrameView& view, double width, double points);

/// Whether a map has a bar, to which `colours`, `range_low` and `range_high` apply.
bool has_bar(const MapLayers& layers);

/// Stress ratio below which a grain is white in the map of gamma (paper, Fig. 10).
inline constexpr double white_below = 0.05;

}  // namespace talus::pictures
